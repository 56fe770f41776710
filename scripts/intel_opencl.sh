#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Prints the folder to set OCL_ICD_VENDORS to for Intel's OpenCL runtime for CPUs, the second driver of the checks. With
# --install fetches it first when it is missing, from Python's package index, in the versions of intel_opencl.txt, into
# a folder that nothing else looks at.
set -euo pipefail
cd "$(dirname "$0")"

folder=${XDG_CACHE_HOME:-$HOME/.cache}/boxwood/intel-opencl-$(sha256sum intel_opencl.txt | cut -c 1-12)
if [[ ! -d $folder && ${1:-} == --install ]]; then
    echo "setup: fetching Intel's OpenCL runtime (250 MB) for the checks" >&2
    mkdir -p "${folder%/*}"
    scratch=$(mktemp -d "$folder.XXXXXX")
    trap 'rm -rf "$scratch"' EXIT
    if ! python3 -m pip download --quiet --no-deps --only-binary :all: --require-hashes -r intel_opencl.txt \
        -d "$scratch" >&2; then
        echo "setup: Intel's OpenCL runtime, the second driver of the checks, is not in Python's package index." >&2
        exit 1
    fi
    mkdir "$scratch/vendors"
    for wheel in "$scratch"/*.whl; do
        python3 -m zipfile -e "$wheel" "$scratch"
        rm "$wheel"
    done
    mkdir "$scratch/lib"
    mv "$scratch"/*.data/data/lib/* "$scratch/lib"
    echo "$folder/lib/libintelocl.so" >"$scratch/vendors/intel.icd"
    mv -T "$scratch" "$folder"
fi
if [[ ! -d $folder ]]; then
    echo "intel_opencl: Intel's OpenCL runtime is not there; scripts/setup.sh --checks fetches it." >&2
    exit 1
fi
echo "$folder/vendors"
