#!/usr/bin/env bash
# SPDX-License-Identifier: MIT OR Apache-2.0
# What a solver does with the package, each way it may: installs it, moves the prefix, and builds and
# runs programs against it. Run by scripts/test, or alone: tests/consumer/run.sh
. "$(dirname "${BASH_SOURCE[0]}")/../../scripts/lib.sh"

here=$root/tests/consumer
work=$root/build/consumer
prefix=$work/moved/prefix
rm -rf "$work"
mkdir -p "$work/moved"

version=$(sed -n 's/^version = "\(.*\)"$/\1/p' "$root/Cargo.toml")
soname=libembound.so.${version%.*}

# consume DIRECTORY [cmake arguments]: configures, builds and runs the consumer; the outputs of its
# programs must agree, and lie in DIRECTORY/output.
consume() (
    set -e
    build=$work/$1
    shift
    cmake -S "$here" -B "$build" "$@"
    cmake --build "$build" -j "$jobs"
    cd "$build"
    ls with_*
    for program in with_*; do
        "./$program" >"$program.out"
        cmp "$program.out" with_embound.out
    done
    cp with_embound.out output
)

same_output() (
    set -e
    cd "$work"
    for output in "$@"; do
        test -s "$output"
        cmp "$output" "$1"
    done
)

refuses() { # refuses EXPECTED_MESSAGE DIRECTORY [cmake arguments]
    local expected=$1 build=$work/$2 answer
    shift 2
    if answer=$(cmake -S "$here" -B "$build" -DLANGUAGE=C -DHOW=find_package "-DCMAKE_PREFIX_PATH=$prefix" "$@" 2>&1); then
        echo "accepted: $*"
        return 1
    fi
    printf '%s\n' "$answer"
    printf '%s' "$answer" | tr -s '\n ' ' ' | grep -q -e "$expected"
}

# `! command` would not end a `set -e` function: this does.
lacks() { if grep -e "$1"; then return 1; fi; }

needed() { readelf -d "$1" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p'; }

# --- the installed tree ---------------------------------------------------------------------------

install_and_move() { install_package "$work/first" && mv "$work/first" "$prefix"; }

has_soname() (
    set -e
    cd "$prefix/lib"
    readelf -d libembound.so | grep "SONAME.*\[$soname\]"
    test "$(readlink libembound.so)" = "$soname"
    test "$(readlink "$soname")" = "libembound.so.$version"
)

# Neither the place it was built, nor the one it was installed to, nor the builder's home.
names_no_path() {
    local path found=0
    for path in "$root" "$work" "${CARGO_HOME:-$HOME/.cargo}" "$HOME/" "$(rustc --print sysroot)"; do
        if [ "$path" != // ] && grep -rlaF -e "$path" "$prefix"; then
            echo "name $path"
            found=1
        fi
    done
    return $found
}

has_licences() (
    set -e
    cd "$prefix/share/doc/embound"
    test -s LICENSE-MIT -a -s LICENSE-APACHE -a -s README.md -a -s CHANGELOG.md
    # Every crate that cargo says is linked in, and the number of them.
    crates=$(cd "$root" && cargo tree --locked --edges normal --prefix none --format '{p}' |
        sed -n 's/^\([^ ]*\) v\([^ ]*\)$/\1-\2/p; s/^\([^ ]*\) v\([^ ]*\) (\*)$/\1-\2/p' | sort -u)
    test -n "$crates"
    for crate in $crates; do
        ls "third-party/$crate"/*
        grep -x "$crate" third-party/README.txt
    done
)

step "install, then move the prefix" install_and_move || { total consumer; exit; }
step "SONAME $soname and its links" has_soname
step "no path of the build in the installed tree" names_no_path
step "licences of embound and of every crate compiled in" has_licences

# --- find_package ---------------------------------------------------------------------------------

languages="C CXX"
if present gfortran; then
    languages="$languages Fortran"
else
    skip "a project of Fortran alone" "no gfortran"
fi
generators=("Unix Makefiles")
if present ninja-build; then
    generators+=("Ninja")
else
    skip "find_package with Ninja" "no ninja"
fi
for generator in "${generators[@]}"; do
    for language in $languages; do
        step "find_package in a project of $language alone, $generator" \
            consume "find-$language-${generator##* }" -G "$generator" -DLANGUAGE=$language -DHOW=find_package \
            -DVERSION=0.1 "-DCMAKE_PREFIX_PATH=$prefix"
    done
done
outputs=(find-C-Makefiles/output find-CXX-Makefiles/output)

linked_as_meant() (
    set -e
    cd "$work/find-C-Makefiles"
    needed with_shared | grep -x "$soname"
    needed with_embound | grep -x "$soname"
    needed with_static | lacks embound
    # The prefix the program was linked against is all it may know.
    readelf -d with_shared | sed -n 's/.*R.*PATH.*\[\(.*\)\]/\1/p' | grep -x "$prefix/lib"
)
step "programs record $soname, or nothing when static" linked_as_meant

for accepted in 0.1 0.1.0; do
    step "version $accepted accepted" cmake -S "$here" -B "$work/version-$accepted" -DLANGUAGE=C \
        -DHOW=find_package -DVERSION=$accepted "-DCMAKE_PREFIX_PATH=$prefix"
done
for refused in 0.2 1.0 0.0.9 0.1.99; do
    step "version $refused refused" refuses "version: $version" "version-$refused" -DVERSION=$refused
done
step "components shared and static accepted" cmake -S "$here" -B "$work/components" -DLANGUAGE=C \
    -DHOW=find_package -DVERSION=0.1 "-DCOMPONENTS=COMPONENTS;shared;static" "-DCMAKE_PREFIX_PATH=$prefix"
step "an unknown component refused" refuses "component \`gpu\` is not in" component-gpu "-DCOMPONENTS=COMPONENTS;gpu"

# --- without CMake --------------------------------------------------------------------------------

by_hand() (
    set -e
    mkdir -p "$work/plain"
    cc "$here/main.c" -I "$prefix/include" -L "$prefix/lib" -lembound -o "$work/plain/with_shared"
    c++ "$here/main.cpp" -std=c++17 -I "$prefix/include" -L "$prefix/lib" -l:libembound.a -lgcc_s -lutil -lrt -lpthread -lm -ldl -lc \
        -o "$work/plain/with_static"
    cd "$work/plain"
    LD_LIBRARY_PATH=$prefix/lib ./with_shared >shared.out
    ./with_static >static.out
)
step "a plain compiler line" by_hand
outputs+=(plain/shared.out plain/static.out)

by_pkg_config() ( # the words pkg-config prints are meant to be split
    set -e
    export PKG_CONFIG_PATH=$prefix/lib/pkgconfig
    mkdir -p "$work/pkg-config"
    cd "$work/pkg-config"
    pkg-config --exact-version="$version" embound
    cc "$here/main.c" $(pkg-config --cflags --libs embound) -o with_shared
    c++ -std=c++17 "$here/main.cpp" $(pkg-config --cflags --libs embound-static) -o with_static
    cc "$here/main.c" $(pkg-config --static --cflags --libs embound | sed 's/-lembound/-l:libembound.a/') -o with_private
    needed with_shared | grep -x "$soname"
    needed with_static | lacks embound
    needed with_private | lacks embound
    LD_LIBRARY_PATH=$prefix/lib ./with_shared >shared.out
    ./with_static >static.out
    ./with_private >private.out
)
step "pkg-config, shared and static" by_pkg_config
outputs+=(pkg-config/shared.out pkg-config/static.out pkg-config/private.out)

# --- as part of the solver's build ----------------------------------------------------------------

inside=("-DEMBOUND_SOURCE=$root" "-DEMBOUND_CARGO_TARGET_DIR=$package_build/cargo")
step "add_subdirectory in a project of C alone" consume add_subdirectory -DLANGUAGE=C -DHOW=add_subdirectory "${inside[@]}"
step "FetchContent in a project of C++ alone, ${generators[-1]}" \
    consume FetchContent -G "${generators[-1]}" -DLANGUAGE=CXX -DHOW=FetchContent "${inside[@]}"
outputs+=(add_subdirectory/output FetchContent/output)
step "the same bits from C, C++, shared, static, installed, in the build" same_output "${outputs[@]}"

up_to_date() { # a second build links nothing again
    cmake --build "$work/FetchContent" >"$work/second-build" 2>&1 || return 1
    cat "$work/second-build"
    lacks "[Ll]inking" <"$work/second-build"
}
step "a second build has nothing to link" up_to_date

# --- one library alone, no network, an old Rust ---------------------------------------------------

# A copy of the sources, in a path with spaces, with vendored crates and a cargo that has no others.
static_alone() (
    set -e
    source="$work/a copy"
    mkdir -p "$source/.cargo"
    cd "$root"
    git ls-files -z --cached --others --exclude-standard | xargs -0 cp --parents -t "$source"
    cargo vendor --locked "$source/vendor" >"$source/.cargo/config.toml"
    CARGO_HOME="$work/empty home" cmake -S "$source" -B "$source/build" -DEMBOUND_OFFLINE=ON -DEMBOUND_BUILD_SHARED=OFF \
        -DCMAKE_INSTALL_LIBDIR=lib64
    CARGO_HOME="$work/empty home" cmake --build "$source/build"
    cmake --install "$source/build" --prefix "$work/static"
    find "$work/static" | lacks 'libembound\.so'
    export PKG_CONFIG_PATH=$work/static/lib64/pkgconfig
    cc "$here/main.c" $(pkg-config --cflags --libs embound) -o "$work/static/program"
    "$work/static/program" | cmp - "$work/find-C-Makefiles/output"
    rm -rf "$source"
)
step "the static library alone, from vendored crates without a network" static_alone
step "embound::embound is the static library there" \
    consume find-static -DLANGUAGE=C -DHOW=find_package -DVERSION=0.1 "-DCOMPONENTS=COMPONENTS;static" "-Dembound_DIR=$work/static/lib64/cmake/embound"
step "component shared refused there" \
    refuses "component \`shared\` is not in" component-shared "-DCOMPONENTS=COMPONENTS;shared" "-Dembound_DIR=$work/static/lib64/cmake/embound"

old_rust_refused() {
    mkdir -p "$work/old"
    printf '#!/bin/sh\necho cargo 1.80.1\n' >"$work/old/cargo"
    chmod +x "$work/old/cargo"
    if cmake -S "$root" -B "$work/old/build" "-DEMBOUND_CARGO=$work/old/cargo" >"$work/old/answer" 2>&1; then return 1; fi
    tr -s '\n ' ' ' <"$work/old/answer" | grep "is version 1.80.1. embound needs Rust 1.89 or newer"
}
step "an old Rust refused, with advice" old_rust_refused

total consumer
