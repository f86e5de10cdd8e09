// A mesh packed by Draco's own encoder, for test_packed.c.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>

#include <cstring>

extern "C" size_t packDraco(const float (*corners)[3], const uint8_t* triangles, uint8_t* bytes,
                            size_t capacity)
{
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(12);
    const int position =
        builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DataType::DT_FLOAT32);
    for (int i = 0; i < 12; ++i) {
        builder.SetAttributeValuesForFace(position, draco::FaceIndex((uint32_t)i), corners[triangles[3 * i]],
                                          corners[triangles[3 * i + 1]], corners[triangles[3 * i + 2]]);
    }
    const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
    draco::EncoderBuffer buffer;
    if (!encoder.EncodeMeshToBuffer(*mesh, &buffer).ok() || buffer.size() > capacity) {
        return 0;
    }
    memcpy(bytes, buffer.data(), buffer.size());
    return buffer.size();
}
