# SPDX-License-Identifier: MIT
# boxwood_embed_kernels(TARGET SYMBOL ROOT): compiles every .cl and .h file under ROOT into TARGET as a table
# `boxwood::SYMBOL` (see host/runtime/kernel_text.hpp). Run as a script (cmake -P) it writes that table.
if(CMAKE_SCRIPT_MODE_FILE)
  set(entries "")
  string(REPLACE "," ";" FILES "${FILES}")
  foreach(file IN LISTS FILES)
    file(READ "${ROOT}/${file}" hex HEX)
    string(REGEX REPLACE "(..)" "0x\\1," bytes "${hex}")
    string(MAKE_C_IDENTIFIER "text_${file}" id)
    string(APPEND arrays "const unsigned char ${id}[] = {${bytes}0x00};\n")
    string(APPEND entries "    {\"${file}\", reinterpret_cast<const char*>(${id})},\n")
  endforeach()
  file(WRITE "${OUTPUT}" "#include \"runtime/kernel_text.hpp\"\nnamespace boxwood {\nnamespace {\n${arrays}}\n"
    "extern const std::vector<KernelText> ${SYMBOL} = {\n${entries}};\n}\n")
  return()
endif()

function(boxwood_embed_kernels target symbol root)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS RELATIVE "${root}" "${root}/*.cl" "${root}/*.h")
  list(TRANSFORM files PREPEND "${root}/" OUTPUT_VARIABLE paths)
  set(output "${CMAKE_CURRENT_BINARY_DIR}/${symbol}.cpp")
  set(script "${PROJECT_SOURCE_DIR}/scripts/embed_kernels.cmake")
  string(REPLACE ";" "," list "${files}")
  add_custom_command(OUTPUT "${output}"
    COMMAND ${CMAKE_COMMAND} "-DROOT=${root}" "-DFILES=${list}" "-DOUTPUT=${output}" -DSYMBOL=${symbol} -P "${script}"
    DEPENDS ${paths} "${script}" COMMENT "Embedding kernels of ${root}" VERBATIM)
  target_sources(${target} PRIVATE "${output}")
endfunction()
