// What all steps use: sentences, notes, and numbers out of bytes.
#include "gltf/gltf.h"

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>

namespace vtGltf
{

static std::string print(const char* format, va_list arguments)
{
    char text[800];
    vsnprintf(text, sizeof text, format, arguments);
    return text;
}

bool Report::fail(vtResult why, const char* format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const std::string reason = print(format, arguments);
    va_end(arguments);
    result = vtFail(error, why, "model '%.200s': %s", name, reason.c_str());
    return false;
}

void Loader::noteIgnored(const char* format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    ignored.push_back(print(format, arguments));
    va_end(arguments);
}

void Loader::note(const char* format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    notes += (notes.empty() ? "'" : "\n'") + quotable(name) + "': " + print(format, arguments);
    va_end(arguments);
}

bool Loader::canSpend(uint64_t bytes, const std::string& what)
{
    return bytes <= left.memory ||
           fail(vt_errorMemory,
                "%s takes %llu bytes, but all that is read of a file may take %llu; simplify "
                "it" VT_ALLOW("--max-memory"),
                what.c_str(), (unsigned long long)bytes, (unsigned long long)limits.memory);
}

bool Loader::spend(uint64_t bytes, const std::string& what)
{
    if (!canSpend(bytes, what)) {
        return false;
    }
    left.memory -= bytes;
    return true;
}

static bool failTriangles(Loader& loader)
{
    return loader.fail(vt_errorMemory,
                       "it has more than %llu triangles; simplify it" VT_ALLOW("--max-triangles"),
                       (unsigned long long)loader.limits.triangles);
}

bool Loader::canHaveTriangles(uint64_t count)
{
    return count <= limits.triangles || failTriangles(*this);
}

bool Loader::spendTriangles(uint64_t count)
{
    if (count > left.triangles) {
        return failTriangles(*this);
    }
    left.triangles -= count;
    return true;
}

bool Loader::has(const char* what, int index, size_t count)
{
    if (index >= 0 && (size_t)index < count) {
        return true;
    }
    return fail(vt_errorFormat, "it refers to %s %d but has %zu of them" GLTF_DAMAGED, what, index, count);
}

std::string quotable(std::string text)
{
    const auto at = [&](size_t i) { return i < text.size() ? (unsigned char)text[i] : 0u; };
    for (size_t i = 0; i < text.size(); ++i) {
        const bool isTwo = at(i) == 0xc2 && at(i + 1) >= 0x80 && at(i + 1) < 0xa0; // U+0080 to U+009F
        if (at(i) < 32 || at(i) == 127 || isTwo) {
            text.replace(i, isTwo ? 2 : 1, " ");
        }
    }
    size_t end = text.size() > 120 ? 117 : text.size();
    while (end > 0 && (at(end) & 0xc0) == 0x80) { // within a character
        --end;
    }
    return end < text.size() ? text.substr(0, end) + "..." : text;
}

std::string withoutStop(std::string sentence)
{
    sentence.erase(sentence.find_last_not_of(" .\n") + 1);
    return quotable(sentence);
}

std::string label(int index, const std::string& name)
{
    const std::string text = quotable(name);
    return std::to_string(index) + (text.empty() ? "" : ", " + text);
}

std::string counted(size_t count, const char* what)
{
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

uint32_t readU32(const uint8_t* p)
{
    return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

uint32_t readIndex(const Stream& indices, size_t i)
{
    const uint8_t* p = indices.data + i * indices.stride;
    switch (indices.componentType) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return p[0];
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return (uint32_t)p[0] | (uint32_t)p[1] << 8;
    default:
        return readU32(p);
    }
}

float readNumber(const Stream& stream, size_t i, size_t k)
{
    const uint8_t* p = stream.data + i * stream.stride;
    const auto word = [&] { return (uint32_t)p[2 * k] | (uint32_t)p[2 * k + 1] << 8; };
    const auto share = [&](float number, float most) {
        return stream.normalized ? std::fmax(number / most, -1.0f) : number;
    };
    switch (stream.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return share((float)(int8_t)p[k], 127.0f);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return share((float)p[k], 255.0f);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return share((float)(int16_t)word(), 32767.0f);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return share((float)word(), 65535.0f);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return (float)readU32(p + 4 * k);
    default: {
        const uint32_t bits = readU32(p + 4 * k);
        float value;
        memcpy(&value, &bits, sizeof value);
        return value;
    }
    }
}

Matrix multiply(const Matrix& a, const Matrix& b)
{
    Matrix product;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            double sum = 0.0;
            for (int k = 0; k < 4; ++k) {
                sum += a.m[4 * k + row] * b.m[4 * column + k];
            }
            product.m[4 * column + row] = sum;
        }
    }
    return product;
}

Matrix composeMatrix(const double t[3], const double r[4], const double s[3])
{
    const double length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
    const double x = r[0] / length, y = r[1] / length, z = r[2] / length, w = r[3] / length;
    const double rotation[3][3] = {
        {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
        {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
        {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)},
    };
    Matrix matrix;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            matrix.m[4 * column + row] = s[column] * rotation[column][row];
        }
        matrix.m[12 + row] = t[row];
    }
    return matrix;
}

} // namespace vtGltf
