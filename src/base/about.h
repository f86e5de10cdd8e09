// What a thing is, in a line: only programs with a command line tell it, so a page does not load it.
#pragma once

#ifdef __EMSCRIPTEN__
#define VT_ABOUT(text) ""
#else
#define VT_WITH_ABOUT ///< structs have the fields that hold nothing else
#define VT_ABOUT(text) text
#endif

/// Files beside a model (vtModelDef.readFile), and what is packed in it: a page's element has one file, and
/// no library that unpacks.
#ifndef __EMSCRIPTEN__
#define VT_WITH_FILES 1
#else
#define VT_WITH_FILES 0
#endif

/// How a user allows more than vtLimits does, in a sentence; pages have the default.
#ifndef __EMSCRIPTEN__
#define VT_ALLOW(option) ", or allow more (" option ", vtLimits)"
#else
#define VT_ALLOW(option) ""
#endif

/// Views as matrices, and pictures of a host's: vtFrame.viewMatrix, overlay and hostColor. A page's element
/// has its canvas to itself, and goes without what it does not use; the build for three.js says 1.
#ifndef VT_WITH_HOST
#ifndef __EMSCRIPTEN__
#define VT_WITH_HOST 1
#else
#define VT_WITH_HOST 0
#endif
#endif

/// A ground, a backdrop, panels, and files that are animated: a page loads another core once it needs one of
/// them, which says 1.
#ifndef VT_IS_FULL
#ifndef __EMSCRIPTEN__
#define VT_IS_FULL 1
#else
#define VT_IS_FULL 0
#endif
#endif
