# SPDX-License-Identifier: MIT OR Apache-2.0
# Sourced by scripts/demo, scripts/test and tests/consumer/run.sh: what a machine needs, the one build
# of the package they share, and counted steps. bash, without `set -e`: every step reports its status.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
package_build=$root/build/embound
jobs=$(nproc 2>/dev/null || echo 2)

die() {
    printf '%s\n' "$@" >&2
    exit 1
}

# --- what the machine needs -----------------------------------------------------------------------

at_least() { # at_least VERSION MINIMUM
    [ "$(printf '%s\n%s\n' "$2" "$1" | sort -V | head -n 1)" = "$2" ]
}

rust_version() { (cd "$root" && cargo --version 2>/dev/null | cut -d ' ' -f 2); }

require_rust() {
    local minimum version
    minimum=$(sed -n 's/^rust-version = "\(.*\)"$/\1/p' "$root/Cargo.toml")
    version=$(rust_version)
    if ! at_least "${version:-0}" "$minimum"; then # a distribution's, or none: rustup's may not be in PATH
        export PATH="${CARGO_HOME:-$HOME/.cargo}/bin:$PATH"
        hash -r
        version=$(rust_version)
    fi
    [ -n "$version" ] || die "cargo is not here: embound needs Rust $minimum or newer." \
        "Install it from https://rustup.rs and run this again."
    at_least "$version" "$minimum" || die "This is Rust $version; embound needs $minimum or newer." \
        "Update it (rustup update stable, or https://rustup.rs) and run this again."
}

as_root() { # runs a command as root where that needs no password
    if [ "$(id -u)" = 0 ]; then "$@"; else sudo -n "$@"; fi
}

may_install() {
    command -v apt-get >/dev/null 2>&1 && as_root true >/dev/null 2>&1
}

can_compile() { # can_compile COMPILER LANGUAGE SOURCE [FLAG...]
    local compiler=$1 language=$2 source=$3
    shift 3
    printf '%s\n' "$source" | "$compiler" -x "$language" - -o /dev/null "$@" >/dev/null 2>&1
}

# present PACKAGE: whether what the Debian package of that name brings is here.
present() {
    case $1 in
        g++) can_compile c++ c++ '#include <cstdio>
int main() { return std::puts("") < 0; }' ;;
        gcc) can_compile cc c 'int main(void) { return 0; }' ;;
        libpng-dev) can_compile c++ c++ '#include <png.h>
int main() { return png_access_version_number() == 0; }' -lpng ;;
        pkg-config) command -v pkg-config >/dev/null 2>&1 ;;
        ninja-build) command -v ninja >/dev/null 2>&1 ;;
        binutils) command -v readelf >/dev/null 2>&1 ;;
        *) command -v "$1" >/dev/null 2>&1 ;;
    esac
}

absent() { # absent PACKAGE...: those that are not here
    local package
    for package in "$@"; do
        present "$package" || printf '%s ' "$package"
    done
}

install_packages() { # quiet, but the end of apt's answer is shown when it fails
    local log
    log=$(mktemp)
    echo "installing $*"
    if as_root apt-get update >"$log" 2>&1 &&
        as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$@" >>"$log" 2>&1; then
        rm -f "$log"
        return 0
    fi
    tail -n 15 "$log" >&2
    rm -f "$log"
    return 1
}

require() { # require PACKAGE...: installs what is missing, or says what to install and stops
    local missing
    missing=$(absent "$@")
    [ -z "$missing" ] && return
    # shellcheck disable=SC2086 # a list of package names
    if may_install; then install_packages $missing; fi
    missing=$(absent "$@")
    [ -z "$missing" ] && return
    die "Missing: $missing" "Install what these Debian packages bring, for example by" \
        "    sudo apt-get install $missing" "and run this again."
}

wish() { # wish PACKAGE...: installs what it may; checks that need what is still missing are skipped
    local missing
    missing=$(absent "$@")
    # shellcheck disable=SC2086
    if [ -n "$missing" ] && may_install; then install_packages $missing; fi
}

# --- counted steps --------------------------------------------------------------------------------

passed=0
failed=0
skipped=0
logs=$root/build/logs

step() { # step NAME COMMAND...: quiet, counted; the log's end is shown when it fails
    local name=$1 log status started=$SECONDS
    shift
    log=$logs/$(printf '%s' "$name" | tr -c 'A-Za-z0-9.+=-' '_').log
    mkdir -p "$logs"
    "$@" >"$log" 2>&1 </dev/null
    status=$?
    if [ $status = 0 ]; then
        passed=$((passed + 1))
        printf 'ok      %s (%d s)\n' "$name" $((SECONDS - started))
    else
        failed=$((failed + 1))
        printf 'FAILED  %s (status %d); the end of %s:\n' "$name" $status "$log"
        tail -n 40 "$log" | sed 's/^/        /'
    fi
    return $status
}

skip() { # skip NAME REASON
    skipped=$((skipped + 1))
    printf 'skipped %s: %s\n' "$1" "$2"
}

total() { # the last line, and the exit status
    printf '%s%d passed, %d failed' "${1:+$1: }" $passed $failed
    if [ $skipped != 0 ]; then printf ', %d skipped' $skipped; fi
    echo
    [ $failed = 0 ]
}

# --- the package ----------------------------------------------------------------------------------

build_package() {
    cmake -S "$root" -B "$package_build" -DCMAKE_INSTALL_LIBDIR=lib &&
        cmake --build "$package_build"
}

install_package() { # install_package PREFIX: afresh
    rm -rf "$1" && cmake --install "$package_build" --prefix "$1"
}

build_examples() { # build_examples PREFIX BUILD [TARGET]: as a solver would, through find_package
    cmake -S "$root/cpp-examples" -B "$2" "-Dembound_DIR=$1/lib/cmake/embound" &&
        cmake --build "$2" -j "$jobs" --target "${3:-all}"
}
