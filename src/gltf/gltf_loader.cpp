// What all steps use: sentences, and numbers out of bytes.
#include "gltf/gltf.h"

#include <cstdarg>
#include <cstdio>

namespace vtGltf
{

bool Loader::fail(vtResult why, const char* format, ...)
{
    char reason[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(reason, sizeof reason, format, arguments);
    va_end(arguments);
    result = vtFail(error, why, "model '%.200s': %s", def->name != nullptr ? def->name : "", reason);
    return false;
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
    for (char& c : text) {
        c = (unsigned char)c < 32 ? ' ' : c;
    }
    while (!text.empty() && (text.back() == ' ' || text.back() == '.')) {
        text.pop_back();
    }
    return text.size() > 120 ? text.substr(0, 117) + "..." : text;
}

std::string label(int index, const std::string& name)
{
    const std::string text = quotable(name);
    return std::to_string(index) + (text.empty() ? "" : ", " + text);
}

uint32_t readU32(const uint8_t* p)
{
    return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

} // namespace vtGltf
