# NOTICES.txt: the licences of others' code that is compiled in, from the copyright files of Debian's packages.
set(VT_COPYRIGHTS /usr/share/doc CACHE PATH "Folder with PACKAGE/copyright of what is compiled in")

set(packages libtinygltf-dev nlohmann-json3-dev)
if(EMSCRIPTEN)
  list(APPEND packages emscripten)
endif()
if(draco IN_LIST decoder_libraries) # the code in its headers
  list(APPEND packages libdraco-dev)
endif()
list(JOIN packages ", " names)
set(text "Vitrine holds compiled code of others: ${names}.
These are the copyright files of the packages, which also tell of tests and tools that Vitrine has nothing of.\n")
foreach(package IN LISTS packages)
  set(file ${VT_COPYRIGHTS}/${package}/copyright)
  if(NOT EXISTS ${file})
    message(FATAL_ERROR "${file}, the licence of what is compiled in, not found: install ${package} anew, name another "
      "folder with -DVT_COPYRIGHTS=FOLDER, or install nothing with -DVT_INSTALL=OFF")
  endif()
  file(READ ${file} copyright)
  string(APPEND text "\n${package}\n\n${copyright}")
endforeach()
set(notices ${PROJECT_BINARY_DIR}/NOTICES.txt)
file(CONFIGURE OUTPUT ${notices} CONTENT "@text@" @ONLY)
