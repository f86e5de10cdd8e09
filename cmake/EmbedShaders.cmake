# Turns the files of shaders_es3/ into C arrays, so that the library carries its shaders.
# Run as: cmake -DSOURCES="a.frag;b.glsl" -DOUTPUT_C=... -DOUTPUT_H=... -P EmbedShaders.cmake
# peel.frag becomes vtChunk_peel_frag, frame.glsl becomes vtChunk_frame, constants.h vtChunk_constants.
set(declarations "// Made from shaders_es3/ by cmake/EmbedShaders.cmake; do not edit.\n#pragma once\n\n#include \"gl/program.h\"\n\n")
set(definitions "// Made from shaders_es3/ by cmake/EmbedShaders.cmake; do not edit.\n#include \"shaders.h\"\n\n")
foreach(source IN LISTS SOURCES)
  get_filename_component(file ${source} NAME)
  string(REGEX REPLACE "\\.(glsl|h)$" "" symbol ${file})
  string(REPLACE "." "_" symbol ${symbol})
  # Comments, indentation and blanks about most signs stay behind, line ends do not: a driver's line numbers are
  # those of the file.
  file(READ ${source} text)
  string(REGEX REPLACE "[ \t]*//[^\n]*" "" text "${text}")
  string(REGEX REPLACE "\n[ \t]+" "\n" text "${text}")
  if(NOT text MATCHES "#") # a macro's name and its text must stay apart
    string(REGEX REPLACE " *([*/=<>?:,&|(){}]) *" "\\1" text "${text}")
  endif()
  file(WRITE ${OUTPUT_C}.part "${text}")
  file(READ ${OUTPUT_C}.part hex HEX)
  file(REMOVE ${OUTPUT_C}.part)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
  string(APPEND declarations "extern const vtChunk vtChunk_${symbol};\n")
  string(APPEND definitions "static const char ${symbol}[] = {${bytes}0x00};\nconst vtChunk vtChunk_${symbol} = {\"${file}\", ${symbol}};\n")
endforeach()
file(WRITE ${OUTPUT_H} "${declarations}")
file(WRITE ${OUTPUT_C} "${definitions}")
