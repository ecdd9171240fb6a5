# SPDX-License-Identifier: MIT OR Apache-2.0
# Finds cargo and rustc, refuses those older than Cargo.toml's rust-version, and learns the size of a
# pointer: EMBOUND_CARGO, EMBOUND_RUSTC, embound_pointer_size.

set(embound_rust_hints "$ENV{CARGO_HOME}/bin" "$ENV{HOME}/.cargo/bin")
find_program(EMBOUND_CARGO cargo HINTS ${embound_rust_hints} DOC "cargo, of Rust ${embound_rust_minimum} or newer")
find_program(EMBOUND_RUSTC rustc HINTS ${embound_rust_hints} DOC "rustc, of Rust ${embound_rust_minimum} or newer")
set(embound_rust_advice "embound needs Rust ${embound_rust_minimum} or newer; https://rustup.rs installs it")

foreach(tool CARGO RUSTC)
  string(TOLOWER ${tool} name)
  if(NOT EMBOUND_${tool})
    message(FATAL_ERROR "embound: ${name} not found in PATH or ~/.cargo/bin. ${embound_rust_advice}.")
  endif()
  execute_process(COMMAND "${EMBOUND_${tool}}" --version WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}"
    OUTPUT_VARIABLE answer ERROR_VARIABLE answer_error OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT answer MATCHES "^${name} ([0-9]+\\.[0-9]+\\.[0-9]+)")
    message(FATAL_ERROR "embound: ${EMBOUND_${tool}} --version says `${answer}${answer_error}`. ${embound_rust_advice}.")
  endif()
  if(CMAKE_MATCH_1 VERSION_LESS embound_rust_minimum)
    message(FATAL_ERROR "embound: ${EMBOUND_${tool}} is version ${CMAKE_MATCH_1}. ${embound_rust_advice}.")
  endif()
endforeach()
message(STATUS "embound ${PROJECT_VERSION}: building with ${EMBOUND_CARGO}, Rust ${CMAKE_MATCH_1}")

execute_process(COMMAND "${EMBOUND_RUSTC}" --print cfg WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}"
  OUTPUT_VARIABLE answer)
if(NOT answer MATCHES "target_pointer_width=\"([0-9]+)\"")
  message(FATAL_ERROR "embound: ${EMBOUND_RUSTC} --print cfg names no target_pointer_width")
endif()
math(EXPR embound_pointer_size "${CMAKE_MATCH_1} / 8")
