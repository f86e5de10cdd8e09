// EXT_meshopt_compression: buffer views packed by meshoptimizer. KHR_meshopt_compression says the same of
// them, and has a newer coding and a filter more, which libmeshoptimizer does not know before version 0.25.

#include "gltf/gltf.h"

#ifdef VT_WITH_MESHOPT
#include <meshoptimizer.h>
#endif

namespace vtGltf
{

#ifdef VT_WITH_MESHOPT

/// Do mode and filter go with a stride and a count, as the library asserts?
static bool fits(const Compressed& view)
{
    const size_t stride = view.byteStride;
    const bool isPlain = view.filter.empty() || view.filter == "NONE";
    if (view.mode != "ATTRIBUTES") {
        return (view.mode == "INDICES" || (view.mode == "TRIANGLES" && view.count % 3 == 0)) &&
               (stride == 2 || stride == 4) && isPlain;
    }
    return stride > 0 && stride <= 256 && stride % 4 == 0 &&
           (isPlain || view.filter == "EXPONENTIAL" ||
            (view.filter == "OCTAHEDRAL" && (stride == 4 || stride == 8)) ||
            (view.filter == "QUATERNION" && stride == 8));
}

bool decodeView(Loader& loader, const std::string& what, const Compressed& view, Bytes packed,
                std::vector<uint8_t>* decoded)
{
    const size_t stride = view.byteStride, count = view.count;
    if (!fits(view)) {
        return loader.fail(
            vt_errorFormat,
            "%s is packed by %s in mode '%s' with filter '%s', %zu elements of %zu bytes, which cannot be "
            "unpacked; export it uncompressed",
            what.c_str(), view.extension.c_str(), quotable(view.mode).c_str(), quotable(view.filter).c_str(),
            count, stride);
    }
    // No coding packs tighter: a byte of a header for 1024 of vertices, one for each triangle or index.
    const uint64_t size = (uint64_t)count * stride, tightest = view.mode == "ATTRIBUTES" ? 1024 : 12;
    if (size / tightest > packed.size) {
        return loader.fail(
            vt_errorFormat,
            "%s is packed by %s in %zu bytes, too few for the %llu that it declares" GLTF_DAMAGED,
            what.c_str(), view.extension.c_str(), packed.size, (unsigned long long)size);
    }
    if (!loader.spend(size, what)) {
        return false;
    }
    decoded->resize(count * stride + 1); // never empty
    uint8_t* to = decoded->data();
    const int failed =
        view.mode == "ATTRIBUTES"  ? meshopt_decodeVertexBuffer(to, count, stride, packed.data, packed.size)
        : view.mode == "TRIANGLES" ? meshopt_decodeIndexBuffer(to, count, stride, packed.data, packed.size)
                                   : meshopt_decodeIndexSequence(to, count, stride, packed.data, packed.size);
    if (failed != 0) {
        return loader.fail(vt_errorFormat, "%s is packed by %s in a way that cannot be unpacked" GLTF_DAMAGED,
                           what.c_str(), view.extension.c_str());
    }
    decoded->resize(count * stride);
    if (view.filter == "OCTAHEDRAL") {
        meshopt_decodeFilterOct(to, count, stride);
    } else if (view.filter == "QUATERNION") {
        meshopt_decodeFilterQuat(to, count, stride);
    } else if (view.filter == "EXPONENTIAL") {
        meshopt_decodeFilterExp(to, count, stride);
    }
    return true;
}

#else

bool decodeView(Loader& loader, const std::string& what, const Compressed& view, Bytes, std::vector<uint8_t>*)
{
    return loader.fail(vt_errorFormat, "%s is packed by %s", what.c_str(), view.extension.c_str());
}

#endif

} // namespace vtGltf
