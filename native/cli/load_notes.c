#include "cli/load_notes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "mesh/height_field.h"
#include "scene/material.h"
#include "scene/objects.h"
#include "technique/technique.h"

static bool isGlass(const vtScene* scene, uint32_t object)
{
    return !scene->materials[scene->objects[object].material].opaque;
}

static bool isGlassMesh(const vtScene* scene, uint32_t mesh)
{
    bool glass = false;
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        glass = glass || (scene->objects[i].mesh == mesh && isGlass(scene, i));
    }
    return glass;
}

static void printReliefNotes(const char* name, const vtHeightField* field)
{
    fprintf(stderr,
            "vitrine: '%s': relief of %d x %d samples, cell %g, z %g to %g, back at %g, %.1f MB of heights\n",
            name, field->width, field->height, (double)field->cell, (double)field->low, (double)field->high,
            (double)field->back, (double)vtHeightField_Bytes(field) / 1e6);
}

/// "x.glb", or where it has several meshes "x.glb, mesh 2".
static void printMeshNotes(const char* name, const vtScene* scene, uint32_t index, bool verbose)
{
    const vtMesh* mesh = &scene->meshes[index];
    char which[32] = "";
    if (scene->meshCount > 1) {
        snprintf(which, sizeof which, ", mesh %u,", index);
    }
    if (mesh->openEdgeCount > 0 && vtScene_UsesSolid(scene, index)) {
        fprintf(
            stderr,
            "vitrine: warning: '%s'%s is not closed (%u open edges); light that enters through a hole never "
            "finds its way out there\n",
            name, which, mesh->openEdgeCount);
    }
    if (mesh->indexCount > 0 && mesh->degenerateCount == mesh->indexCount / 3) {
        fprintf(
            stderr,
            "vitrine: warning: '%s'%s cannot be seen: none of its %u triangles has an area; give them one\n",
            name, which, mesh->degenerateCount);
    }
    if (mesh->normalsComputed) {
        fprintf(stderr, "vitrine: note: '%s'%s lacks normals; they are computed, smooth over its edges\n",
                name, which);
    }
    if (verbose && mesh->heights != NULL) {
        printReliefNotes(name, mesh->heights);
    } else if (verbose) {
        fprintf(stderr, "vitrine: '%s'%s: %u triangles, %u vertices, box %g %g %g to %g %g %g\n", name, which,
                mesh->indexCount / 3, mesh->vertexCount, (double)mesh->boundsMin.x, (double)mesh->boundsMin.y,
                (double)mesh->boundsMin.z, (double)mesh->boundsMax.x, (double)mesh->boundsMax.y,
                (double)mesh->boundsMax.z);
    }
}

/// Says where a scene lies so far from the origin that its shape, or where an eye can stand, is rounded.
static void sayFar(const char* name, const vtScene* scene)
{
    vtVec3 low, high;
    vtScene_Bounds(scene, &low, &high);
    const vtVec3 size = vtSub(high, low);
    const float wide = fmaxf(size.x, fmaxf(size.y, size.z)), reach = fmaxf(vtLength(low), vtLength(high));
    if (wide < reach * 0x1p-16f) {
        fprintf(stderr,
                "vitrine: note: '%s' is %g wide and lies %g from the origin, where numbers are about %.1g "
                "apart, so "
                "places are rounded; move it nearer\n",
                name, (double)wide, (double)reach, (double)(reach * 0x1p-23f));
    }
}

void vtPrintLoaded(const char* name, const vtScene* scene, bool verbose)
{
    for (uint32_t i = 0; i < scene->meshCount; ++i) {
        if (isGlassMesh(scene, i)) {
            printMeshNotes(name, scene, i, verbose);
        }
    }
    sayFar(name, scene);
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        const vtObject* object = &scene->objects[i];
        const vtMaterial* material = &scene->materials[object->material];
        const vtMesh* mesh = &scene->meshes[object->mesh];
        if ((material->checker > 0.0f || material->maps[vt_mapBaseColor].image >= 0) && !isGlass(scene, i) &&
            mesh->texcoords == NULL && mesh->heights == NULL) {
            fprintf(stderr,
                    "vitrine: note: '%s' has no texture coordinates, so it shows no checker or picture\n",
                    name);
            break;
        }
    }
    for (const char* line = scene->notes; line != NULL && *line != '\0';) {
        const size_t length = strcspn(line, "\n");
        fprintf(stderr, "vitrine: note: %.*s\n", (int)length, line);
        line += length + (line[length] != '\0');
    }
    if (verbose && scene->allGlass) {
        fprintf(stderr,
                "vitrine: note: '%s' has no material that is glass; all of them are taken for glass\n", name);
    }
}

/// Says what a technique does not draw of the scene's materials.
static void sayLooks(vtTechnique technique, const vtScene* scene)
{
    const vtTechniqueInfo* info = vtTechnique_Info(technique);
    if (!vtTechnique_Row(technique)->traces && vtScene_HasLooks(scene)) {
        fprintf(stderr,
                "vitrine: note: technique %s draws plain materials only: no thin walls, alpha, lights, nor "
                "pictures "
                "but two of opaque things; exact and heightfield do\n",
                info->id);
    }
}

/// Says that a technique draws no roughness or dispersion, where glass has it.
static void sayGlass(vtTechnique technique, const vtScene* scene, const vtFrame* frame)
{
    const vtTechniqueRow* row = vtTechnique_Row(technique);
    bool rough = false, disperses = false;
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        const vtMaterial* material = &scene->materials[scene->objects[i].material];
        rough |= !material->opaque && vtMaterial_Roughness(material, frame->roughness) > 0.0f;
        disperses |= !material->opaque && vtMaterial_Dispersion(material, frame->dispersion) > 0.0f;
    }
    disperses &= !row->dispersion;
    rough &= !row->roughness;
    if (rough || disperses) {
        fprintf(stderr, "vitrine: note: technique %s draws no %s of glass; reference does\n", row->info.id,
                rough && disperses ? "roughness and dispersion"
                : rough            ? "roughness"
                                   : "dispersion");
    }
}

void vtPrintLeftOut(vtTechnique technique, const vtScene* scene, const vtFrame* frame)
{
    sayLooks(technique, scene);
    sayGlass(technique, scene, frame);
}
