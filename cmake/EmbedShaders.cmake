# Turns the files of shaders_es3/ into C arrays, so that the library carries its shaders.
# Run as: cmake -DSOURCES="a.frag;b.glsl" -DOUTPUT_C=... -DOUTPUT_H=... [-DSHORT=ON] [-DLATER="..." -DOUTPUT_LATER=...] -P EmbedShaders.cmake
# OUTPUT_LATER, where given: a file that a page loads once a frame needs one of LATER, names of files whose text is there
# and not in the C. In it, each ended by a form feed: the mark by which the core knows the file as its own, then name and
# text of each.
# peel.frag becomes vtChunk_peel_frag, frame.glsl becomes vtChunk_frame, constants.h vtChunk_constants.

# SHORT: the names that the shaders give get two letters, the same in all of them, and lines are joined, which
# takes 3 KB off a page's compressed wasm. Those that C knows have an underscore (u_size) and stay, as do GLSL's own, of which these are all
# that have four letters or more and begin with a small one.
set(glsl_words
  abs acos acosh asin asinh atan atanh binding bool break bvec2 bvec3 bvec4 case ceil centroid clamp const continue cosh cross
  default define defined degrees determinant discard distance elif else endif equal error exp2 faceforward false flat
  float floatBitsToInt floatBitsToUint floor fract fwidth greaterThan greaterThanEqual highp ifdef ifndef inout
  intBitsToFloat inverse inversesqrt invariant isampler2D isampler2DArray isinf isnan ivec2 ivec3 ivec4 layout length
  lessThan lessThanEqual line location log2 lowp main mat2 mat3 mat4 mat2x3 mat2x4 mat3x2 mat3x4 mat4x2 mat4x3
  matrixCompMult mediump normalize notEqual outerProduct packHalf2x16 packSnorm2x16 packUnorm2x16 pragma precision radians
  reflect refract return round roundEven sampler2D sampler2DArray sampler3D samplerCube sign sinh smooth smoothstep sqrt
  std140 step struct switch tanh texelFetch texelFetchOffset texture textureGrad textureLod textureLodOffset textureOffset
  textureProj textureSize transpose true trunc uint uintBitsToFloat undef uniform unpackHalf2x16 unpackSnorm2x16
  unpackUnorm2x16 usampler2D usampler2DArray uvec2 uvec3 uvec4 vec2 vec3 vec4 version void while dFdx dFdy wwww xxxx yyyy zzzz)
if(SHORT)
  set(words "")
  foreach(source IN LISTS SOURCES)
    file(READ ${source} text)
    string(REGEX REPLACE "//[^\n]*" "" text "${text}")
    string(REGEX MATCHALL "[A-Za-z0-9_]+" found "${text}")
    list(APPEND words ${found})
  endforeach()
  list(REMOVE_DUPLICATES words)
  set(short_names "")
  foreach(first c d e f h i j k l m n o p q s t u v)
    foreach(second a b c d e f g h i j k l m n o p q r s t u v w x y z A B C D E F G H I J K L M N O P Q R S T U V W X Y Z)
      list(APPEND short_names ${first}${second})
    endforeach()
  endforeach()
  list(REMOVE_ITEM short_names ${words} if in do) # and no swizzle: st, sp, pq, ...
  list(FILTER short_names EXCLUDE REGEX "^[stpq][stpq]$")
  list(FILTER words INCLUDE REGEX "^[a-z][A-Za-z0-9][A-Za-z0-9][A-Za-z0-9]+$")
  list(REMOVE_ITEM words ${glsl_words})
  list(LENGTH words word_count)
  list(SUBLIST short_names 0 ${word_count} short_names)
endif()

function(shorten variable)
  string(REGEX REPLACE "([A-Za-z0-9_]+)" "@\\1@" text "${${variable}}")
  foreach(word short IN ZIP_LISTS words short_names)
    string(REPLACE "@${word}@" "${short}" text "${text}")
  endforeach()
  string(REPLACE "@" "" text "${text}")
  string(REGEX REPLACE "([0-9])\\.0([^0-9])" "\\1.\\2" text "${text}") # 1.0 is 1. to GLSL
  # Lines become one, but for those of the preprocessor.
  string(REGEX REPLACE "\n\n+" "\n" text "${text}")
  string(REGEX REPLACE "(#[^\n]*)\n" "\\1@" text "${text}")
  string(REPLACE "\n#" "@#" text "${text}")
  string(REGEX REPLACE "([;{},(&|=+*?:<>-])\n" "\\1" text "${text}")
  string(REPLACE "@" "\n" text "${text}")
  string(APPEND text "\n") # what follows may begin with #
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

set(later "")
set(all_texts "")
string(ASCII 12 end)
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
  while(text MATCHES "#[^\n ]* ") # a macro's name and its text must stay apart
    string(REGEX REPLACE "(#[^\n ]*) " "\\1@" text "${text}")
  endwhile()
  string(REGEX REPLACE " *([*/=<>?:,&|(){}]) *" "\\1" text "${text}")
  string(REGEX REPLACE " ([+-]) ([A-Za-z0-9_(.])" "\\1\\2" text "${text}") # but not a - -b
  string(REPLACE "@" " " text "${text}")
  if(SHORT)
    shorten(text)
  endif()
  string(APPEND all_texts "${text}")
  string(APPEND declarations "extern const vtChunk vtChunk_${symbol};\n")
  list(FIND LATER "${file}" place)
  if(place GREATER -1)
    string(APPEND later "${file}${end}${text}${end}")
    string(APPEND definitions "const vtChunk vtChunk_${symbol} = {\"${file}\", NULL};\n")
    list(REMOVE_AT LATER ${place})
    continue()
  endif()
  file(WRITE ${OUTPUT_C}.part "${text}")
  file(READ ${OUTPUT_C}.part hex HEX)
  file(REMOVE ${OUTPUT_C}.part)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
  string(APPEND definitions "static const char ${symbol}[] = {${bytes}0x00};\nconst vtChunk vtChunk_${symbol} = {\"${file}\", ${symbol}};\n")
endforeach()
if(LATER)
  message(FATAL_ERROR "EmbedShaders.cmake: LATER names what SOURCES lacks: ${LATER}; correct the names")
endif()
string(MD5 mark "${all_texts}")
string(SUBSTRING ${mark} 0 8 mark)
string(APPEND declarations "#define VT_LATER_MARK \"${mark}\"\n")
if(OUTPUT_LATER)
  file(WRITE ${OUTPUT_LATER} "${mark}${end}${later}")
endif()
file(WRITE ${OUTPUT_H} "${declarations}")
file(WRITE ${OUTPUT_C} "${definitions}")
