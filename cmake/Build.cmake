# SPDX-License-Identifier: MIT OR Apache-2.0
# The target that runs cargo, and the targets that programs in the same build link: embound::shared,
# embound::static and embound::embound, the names find_package gives.

set(embound_crate_types "")
set(embound_libraries "")
if(EMBOUND_BUILD_SHARED)
  list(APPEND embound_crate_types cdylib)
  list(APPEND embound_libraries "${embound_shared}")
endif()
if(EMBOUND_BUILD_STATIC)
  list(APPEND embound_crate_types staticlib)
  list(APPEND embound_libraries "${embound_static}")
endif()
list(JOIN embound_crate_types "," embound_crate_types)

# Cargo alone knows what is out of date, and asking it takes a fraction of a second: so always ask.
# A project that only links embound builds it when something that links it is built.
set(embound_in_all "")
if(EMBOUND_INSTALL)
  set(embound_in_all ALL)
endif()
add_custom_target(embound_cargo ${embound_in_all}
  COMMAND "${CMAKE_COMMAND}"
    "-DCARGO=${EMBOUND_CARGO}" "-DRUSTC=${EMBOUND_RUSTC}" "-DRUSTFLAGS=${EMBOUND_RUSTFLAGS}"
    "-DSOURCE=${PROJECT_SOURCE_DIR}" "-DTARGET_DIR=${EMBOUND_CARGO_TARGET_DIR}" "-DSTAGE=${embound_stage}"
    "-DVERSION=${PROJECT_VERSION}" "-DSONAME=${embound_soname}" "-DCRATE_TYPES=${embound_crate_types}"
    "-DOFFLINE=${EMBOUND_OFFLINE}" -P "${PROJECT_SOURCE_DIR}/cmake/cargo.cmake"
  BYPRODUCTS ${embound_libraries}
  COMMENT "embound: cargo rustc --release"
  USES_TERMINAL VERBATIM)

function(embound_add_imported name type location)
  add_library(embound::${name} ${type} IMPORTED GLOBAL)
  set_target_properties(embound::${name} PROPERTIES IMPORTED_LOCATION "${location}"
    INTERFACE_INCLUDE_DIRECTORIES "${PROJECT_SOURCE_DIR}/include")
  add_dependencies(embound::${name} embound_cargo)
endfunction()

add_library(embound::embound INTERFACE IMPORTED GLOBAL)
if(EMBOUND_BUILD_STATIC)
  embound_add_imported(static STATIC "${embound_static}")
  set_target_properties(embound::static PROPERTIES INTERFACE_LINK_LIBRARIES "${embound_system_libraries}")
  set_target_properties(embound::embound PROPERTIES INTERFACE_LINK_LIBRARIES embound::static)
endif()
if(EMBOUND_BUILD_SHARED)
  embound_add_imported(shared SHARED "${embound_shared}")
  set_target_properties(embound::shared PROPERTIES IMPORTED_SONAME "${embound_soname}")
  set_target_properties(embound::embound PROPERTIES INTERFACE_LINK_LIBRARIES embound::shared)
endif()
