#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs from Debian what building and testing Boxwood needs and this machine lacks. With --checks also what .ci/run
# needs, a second OpenCL driver from Python's package index among it. Silent, and without network, when nothing is
# missing.
set -euo pipefail
cd "$(dirname "$0")/.."

usage() { echo "usage: scripts/setup.sh [--checks]"; }

packages=(g++ cmake ninja-build pkg-config
    pocl-opencl-icd ocl-icd-opencl-dev opencl-c-headers opencl-clhpp-headers
    libglm-dev libtinygltf-dev libopenexr-dev libstb-dev libxxhash-dev
    nlohmann-json3-dev libcli11-dev doctest-dev)
checks=(clang clang-14 libclang-rt-14-dev llvm-spirv-14 clang-format clang-tidy clinfo oclgrind shellcheck
    libembree-dev libtbb-dev python3-matplotlib python3-pip)
second_driver=()

case "${1:-}" in
"") ;;
--checks)
    packages+=("${checks[@]}")
    second_driver=(scripts/intel_opencl.sh --install)
    ;;
--help | -h)
    usage
    exit 0
    ;;
*)
    usage >&2
    exit 2
    ;;
esac

if ! command -v dpkg-query >/dev/null; then
    echo "setup: this is not Debian. Install the counterparts of: ${packages[*]}" >&2
    exit 1
fi

missing=()
for package in "${packages[@]}"; do
    state=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
    [[ $state == installed ]] || missing+=("$package")
done
if [[ ${#missing[@]} -gt 0 ]]; then
    as_root=()
    if [[ $(id -u) != 0 ]]; then
        if ! command -v sudo >/dev/null; then
            echo "setup: run this as root, or install sudo. Missing: ${missing[*]}" >&2
            exit 1
        fi
        as_root=(sudo)
    fi

    echo "setup: installing ${missing[*]}"
    "${as_root[@]}" apt-get -q update
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y --no-install-recommends install "${missing[@]}"
fi
[[ ${#second_driver[@]} -eq 0 ]] || "${second_driver[@]}" >/dev/null
