# SPDX-License-Identifier: BSD-3-Clause
# Steps that scripts/demo and scripts/test share; sourced by them from any folder.
set -euo pipefail
SALMA_ROOT=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
SALMA_SANITIZE=${SALMA_SANITIZE:-}
SALMA_BUILD=${SALMA_BUILD:-$SALMA_ROOT/build${SALMA_SANITIZE:+-sanitized}}

# docs/dependencies.md says why each is there. No recommended packages are pulled in.
SALMA_PACKAGES=(
    g++ cmake ninja-build ccache
    libmrpt-dev libopencv-dev libeigen3-dev libboost-dev libboost-iostreams-dev libsqlitecpp-dev libsqlite3-dev zlib1g-dev
    libcli11-dev nlohmann-json3-dev gnuplot-nox fonts-dejavu-core
    libhwy-dev libnanoflann-dev libceres-dev libv4l-dev libgtest-dev libbenchmark-dev mrpt-apps mrpt-common
    xvfb xdotool openbox
)

say() { printf '== %s\n' "$*"; }

as_root() {
    if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}

install_packages() {
    local missing=() package
    for package in "${SALMA_PACKAGES[@]}"; do
        dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
    done
    if [ ${#missing[@]} = 0 ]; then
        say "packages: all there"
        return
    fi
    say "packages: installing ${missing[*]}"
    export DEBIAN_FRONTEND=noninteractive
    as_root apt-get -q update
    as_root env DEBIAN_FRONTEND=noninteractive \
        apt-get -q install -y --no-install-recommends "${missing[@]}" </dev/null
}

# build [TARGET...]: configures once, then builds the given targets, or everything.
build() {
    local start=$SECONDS targets=() kind=(-DCMAKE_BUILD_TYPE=Release)
    if [ -n "$SALMA_SANITIZE" ]; then  # findings name lines; -O2 would only compile longer
        kind=(-DCMAKE_BUILD_TYPE=RelWithDebInfo "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -g1")
    fi
    if [ $# -gt 0 ]; then targets=(--target "$@"); fi
    mkdir -p "$SALMA_BUILD"
    say "build: ${*:-everything}, into $SALMA_BUILD"
    cmake -S "$SALMA_ROOT" -B "$SALMA_BUILD" -G Ninja "${kind[@]}" \
        -DCMAKE_CXX_COMPILER_LAUNCHER=ccache -DSALMA_SANITIZE="$SALMA_SANITIZE" \
        >"$SALMA_BUILD/configure.log" 2>&1 || {
        cat "$SALMA_BUILD/configure.log"
        return 1
    }
    cmake --build "$SALMA_BUILD" "${targets[@]}"
    say "build: done in $((SECONDS - start)) s"
}
