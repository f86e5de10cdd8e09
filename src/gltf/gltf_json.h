// nlohmann-json under a name of ours, whose values are destroyed without recursion. All that reads JSON
// includes it by this.
#pragma once

#include <string>
#include <vector>

#ifdef __cpp_exceptions
namespace vtNlohmann::std
{
using namespace ::std;

template <typename Json> bool hasChildren(const Json& value)
{
    return value.is_structured() && !value.empty();
}

template <typename Json> void eraseLast(Json& value)
{
    auto last = value.end();
    value.erase(--last);
}

/// Destroys all below a value without a call to itself and without memory: it goes down by the last child, in
/// whose place it keeps what it came from.
template <typename Json> void dissolve(Json& value)
{
    Json above, here = ::std::move(value);
    while (hasChildren(here) || !above.is_null()) {
        if (!hasChildren(here)) {
            here = ::std::move(above);
            above = ::std::move(here.back());
            eraseLast(here);
        } else if (hasChildren(here.back())) {
            Json below = ::std::move(here.back());
            here.back() = ::std::move(above);
            above = ::std::move(here);
            here = ::std::move(below);
        } else {
            eraseLast(here);
        }
    }
}

/// What a JSON value's destructor, which must not fail, moves its children into, so that it need not call
/// itself. Where memory is out they are dissolved.
template <typename T> struct Yielding : ::std::vector<T> {
    void reserve(size_t)
    {
    }
    void push_back(T&& value)
    {
        try {
            ::std::vector<T>::push_back(::std::move(value));
        } catch (const bad_alloc&) {
            dissolve(value);
        }
    }
};

/// nlohmann's vectors: only that one is of values of a class and names no allocator.
template <typename T, typename... Allocator> struct VectorOf {
    using type = ::std::vector<T, Allocator...>;
};
template <typename T> struct VectorOf<T> {
    static constexpr bool yields = is_class_v<T> && !is_same_v<T, string>;
    using type = conditional_t<yields, Yielding<T>, ::std::vector<T>>;
};
template <typename T, typename... Allocator> using vector = typename VectorOf<T, Allocator...>::type;
} // namespace vtNlohmann::std
#endif

#include "gltf/gltf.h"

#include <nlohmann/json.hpp>

namespace vtGltf
{

using Json = nlohmann::json;

/// Drops what is not read of a file's JSON; refuses what tinygltf would misread.
bool tidyDocument(Loader& loader, Json& document);

/// Fills the rig's animations from a tidied file's, and tells its nodes what moves them. The model is there,
/// but for its animations.
bool readAnimations(Loader& loader, const Json& animations);

} // namespace vtGltf
