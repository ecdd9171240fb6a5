# SPDX-License-Identifier: MIT OR Apache-2.0
# Run at build time (cmake -P): builds the libraries with cargo, puts them under ${STAGE}/lib with the
# names they are installed by, and gathers the licences of every crate compiled in under
# ${STAGE}/third-party. See Build.cmake for the variables.

# No path of this machine may stay in the binaries: sources, crates and toolchain get neutral names.
execute_process(COMMAND "${RUSTC}" --print sysroot WORKING_DIRECTORY "${SOURCE}"
  OUTPUT_VARIABLE sysroot OUTPUT_STRIP_TRAILING_WHITESPACE)
if(DEFINED ENV{CARGO_HOME})
  set(cargo_home "$ENV{CARGO_HOME}")
else()
  set(cargo_home "$ENV{HOME}/.cargo")
endif()
separate_arguments(flags UNIX_COMMAND "${RUSTFLAGS}")
list(APPEND flags
  "--remap-path-prefix=${sysroot}=/rust"
  "--remap-path-prefix=${cargo_home}=/cargo"
  "--remap-path-prefix=${SOURCE}=/embound"
  "--remap-path-prefix=${TARGET_DIR}=/target")
string(ASCII 31 separator)
list(JOIN flags "${separator}" flags)
set(ENV{CARGO_ENCODED_RUSTFLAGS} "${flags}")
set(ENV{CARGO_TARGET_DIR} "${TARGET_DIR}")
set(ENV{RUSTC} "${RUSTC}")

# `cargo rustc --crate-type`, because with the manifest's three crate types link-time optimisation is
# silently off. The messages say which packages were compiled in and where the libraries lie.
set(arguments rustc --lib --release --locked --crate-type "${CRATE_TYPES}" --message-format json-render-diagnostics)
if(OFFLINE)
  list(APPEND arguments --offline)
endif()
set(messages "${TARGET_DIR}/messages.json")
file(MAKE_DIRECTORY "${TARGET_DIR}")
execute_process(COMMAND "${CARGO}" ${arguments} WORKING_DIRECTORY "${SOURCE}"
  OUTPUT_FILE "${messages}" RESULT_VARIABLE failed)
if(failed)
  set(advice "")
  if(OFFLINE)
    set(advice ". EMBOUND_OFFLINE is ON: the crates must have been vendored or fetched, see the README")
  endif()
  message(FATAL_ERROR "embound: `cargo rustc` failed (${failed})${advice}")
endif()
file(READ "${messages}" messages)

# The libraries, copied only when they changed so that nothing is linked again in vain.
function(stage built staged)
  string(REGEX MATCHALL "\"[^\"]*/${built}\"" path "${messages}")
  list(REMOVE_DUPLICATES path)
  string(REPLACE "\"" "" path "${path}")
  execute_process(COMMAND "${CMAKE_COMMAND}" -E copy_if_different "${path}" "${STAGE}/lib/${staged}"
    RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "embound: cargo's ${built} (`${path}`) could not be copied to ${STAGE}/lib/${staged}")
  endif()
endfunction()
function(link_library target name)
  if(NOT IS_SYMLINK "${STAGE}/lib/${name}")
    execute_process(COMMAND "${CMAKE_COMMAND}" -E create_symlink "${target}" "${STAGE}/lib/${name}")
  endif()
endfunction()
file(MAKE_DIRECTORY "${STAGE}/lib")
if(CRATE_TYPES MATCHES "cdylib")
  stage(libembound.so "libembound.so.${VERSION}")
  link_library("libembound.so.${VERSION}" "${SONAME}")
  link_library("${SONAME}" libembound.so)
endif()
if(CRATE_TYPES MATCHES "staticlib")
  stage(libembound.a libembound.a)
endif()

# Licences. "package_id" ends in #name@version.
set(third_party "${STAGE}/third-party")
file(REMOVE_RECURSE "${third_party}")
string(REGEX MATCHALL "\"package_id\":\"[^\"]*\",\"manifest_path\":\"[^\"]*\"" packages "${messages}")
list(REMOVE_DUPLICATES packages)
set(names "")
foreach(package IN LISTS packages)
  string(REGEX MATCH "\"package_id\":\"([^\"]*)\",\"manifest_path\":\"([^\"]*)\"" matched "${package}")
  set(id "${CMAKE_MATCH_1}")
  get_filename_component(directory "${CMAKE_MATCH_2}" DIRECTORY)
  if(directory STREQUAL SOURCE)
    continue()
  endif()
  if(NOT id MATCHES "#([^@]+)@([^@]+)$")
    message(FATAL_ERROR "embound: cargo names a package without name and version: `${id}`")
  endif()
  set(name "${CMAKE_MATCH_1}-${CMAKE_MATCH_2}")
  file(GLOB licences "${directory}/LICEN[CS]E*" "${directory}/licen[cs]e*" "${directory}/COPYING*"
    "${directory}/COPYRIGHT*" "${directory}/NOTICE*" "${directory}/UNLICENSE*")
  if(NOT licences)
    message(FATAL_ERROR "embound: ${name} is compiled in, and ${directory} holds no licence text")
  endif()
  file(COPY ${licences} DESTINATION "${third_party}/${name}")
  list(APPEND names "${name}")
endforeach()

# The standard library is compiled in too; a toolchain from rustup carries its notices.
execute_process(COMMAND "${RUSTC}" --version WORKING_DIRECTORY "${SOURCE}"
  OUTPUT_VARIABLE toolchain OUTPUT_STRIP_TRAILING_WHITESPACE)
set(notices "${sysroot}/share/doc/rust/COPYRIGHT-library.html")
if(EXISTS "${notices}")
  file(COPY "${notices}" DESTINATION "${third_party}/rust-std")
  set(where "its notices are in rust-std/")
else()
  set(where "this toolchain came without its notices: https://www.rust-lang.org/policies/licenses")
endif()
list(SORT names)
list(JOIN names "\n" names)
file(WRITE "${third_party}/README.txt" "Compiled into embound ${VERSION}, each under the licence in the directory of its name:\n\n"
  "${names}\n\nand Rust's standard library (${toolchain}), MIT OR Apache-2.0; ${where}.\n")
