// What a thing is, in a line: only programs with a command line tell it, so a page does not load it.
#pragma once

#ifdef __EMSCRIPTEN__
#define VT_ABOUT(text) ""
#else
#define VT_ABOUT(text) text
#endif
