// Vertices as morph targets and skins put them, in the pose that the file has.

#include "gltf/gltf.h"

#include <cmath>

namespace vtGltf
{

static void morph(const Part& part, float* positions, float* normals)
{
    for (const Target& target : part.targets) {
        for (size_t i = 0; i < 3 * part.positions.count; ++i) {
            const auto add = [&](const Stream& stream, float* to) {
                if (stream.data != nullptr && to != nullptr) {
                    to[i] += (float)(target.weight * (double)readNumber(stream, i / 3, i % 3));
                }
            };
            add(target.positions, positions);
            add(target.normals, normals);
        }
    }
}

/// The mean of the joints that a vertex hangs on, weighted; where all weights are 0, the first of them.
static Matrix blend(const Source& source, const Part& part, size_t vertex)
{
    double sum = 0.0;
    Matrix mean = {};
    for (double& number : mean.m) {
        number = 0.0;
    }
    const auto add = [&](const Influence& influence, size_t k, double weight) {
        const size_t joint = (size_t)readNumber(influence.joints, vertex, k);
        for (int i = 0; i < 16 && joint < source.joints.size(); ++i) {
            mean.m[i] += weight * source.joints[joint].m[i];
        }
        sum += weight;
    };
    for (const Influence& influence : part.influences) {
        for (size_t k = 0; k < 4; ++k) {
            const double weight = (double)readNumber(influence.weights, vertex, k);
            if (weight != 0.0) {
                add(influence, k, weight);
            }
        }
    }
    if (!(std::fabs(sum) > 0.0)) {
        add(part.influences[0], 0, 1.0);
    }
    for (double& number : mean.m) {
        number /= sum;
    }
    return mean;
}

/// By the inverse transposed, but for its length.
static void turnNormal(const double* m, float* n)
{
    double cofactors[3][3], turned[3];
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            const int a = (row + 1) % 3, b = (row + 2) % 3, c = (column + 1) % 3, d = (column + 2) % 3;
            cofactors[row][column] = m[4 * c + a] * m[4 * d + b] - m[4 * c + b] * m[4 * d + a];
        }
        turned[row] = cofactors[row][0] * (double)n[0] + cofactors[row][1] * (double)n[1] +
                      cofactors[row][2] * (double)n[2];
    }
    const double determinant = m[0] * cofactors[0][0] + m[1] * cofactors[1][0] + m[2] * cofactors[2][0];
    const double length = std::hypot(turned[0], turned[1], turned[2]) * (determinant < 0.0 ? -1.0 : 1.0);
    for (int row = 0; row < 3; ++row) {
        n[row] = (float)(length != 0.0 ? turned[row] / length : 0.0);
    }
}

void pose(const Source& source, const Part& part, float* positions, float* normals)
{
    morph(part, positions, normals);
    for (size_t i = 0; !part.influences.empty() && i < part.positions.count; ++i) {
        const Matrix matrix = blend(source, part, i);
        const double* m = matrix.m;
        float* p = positions + 3 * i;
        const double x = (double)p[0], y = (double)p[1], z = (double)p[2];
        for (int row = 0; row < 3; ++row) {
            p[row] = (float)(m[row] * x + m[4 + row] * y + m[8 + row] * z + m[12 + row]);
        }
        if (normals != nullptr) {
            turnNormal(m, normals + 3 * i);
        }
    }
}

} // namespace vtGltf
