// A mesh packed by Draco's own encoder, for test_packed.c: its corners as floats, or as booleans that are
// neither true nor false where a coordinate is above 0.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>

#include <cstring>

extern "C" size_t packDraco(const float (*corners)[3], const uint8_t* triangles, bool areBooleans,
                            uint8_t* bytes, size_t capacity)
{
    uint8_t booleans[8][3];
    for (int i = 0; i < 24; ++i) {
        booleans[i / 3][i % 3] = corners[i / 3][i % 3] > 0.0f ? 237 : 0;
    }
    const auto corner = [&](int i) {
        return areBooleans ? (const void*)booleans[triangles[i]] : (const void*)corners[triangles[i]];
    };
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(12);
    const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3,
                                              areBooleans ? draco::DT_BOOL : draco::DT_FLOAT32);
    for (int i = 0; i < 12; ++i) {
        builder.SetAttributeValuesForFace(position, draco::FaceIndex((uint32_t)i), corner(3 * i),
                                          corner(3 * i + 1), corner(3 * i + 2));
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
