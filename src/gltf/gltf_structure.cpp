// What a text of JSON will take once it is parsed: a file of a few megabytes of "{}," would take gigabytes.

#include "gltf/gltf.h"

namespace vtGltf
{

// Bytes, estimated from a few measured files (nlohmann-json 3.11, tinygltf 2.7): of an object with the struct
// that is made of it, of an array, of a text, of a key beside its text, of any value.
static const uint64_t objectBytes = 640, arrayBytes = 64, textBytes = 48, keyBytes = 96, valueBytes = 24;

bool checkStructure(Loader& loader, Bytes text)
{
    const uint64_t most = loader.limits.memory / 32;
    uint64_t bytes = 0;
    bool quoted = false;
    for (size_t i = 0; i < text.size && bytes <= most; ++i) {
        const uint8_t c = text.data[i];
        if (c == '"') {
            quoted = !quoted;
            bytes += quoted ? textBytes : 0;
        } else if (quoted) {
            i += c == '\\';
        } else {
            bytes += c == '{'   ? objectBytes
                     : c == '[' ? arrayBytes
                     : c == ':' ? keyBytes
                     : c == ',' ? valueBytes
                                : 0;
        }
    }
    return bytes <= most ||
           loader.fail(vt_errorMemory,
                       "the objects and lists in its JSON take more than %llu bytes; simplify "
                       "it" VT_ALLOW("--max-memory, of which they may take a 32nd"),
                       (unsigned long long)most);
}

} // namespace vtGltf
