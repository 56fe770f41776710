#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Fails when a file of cl/, host/ or include/ includes one of a higher layer. The layers are the folders of host/,
# lowest first; those below runtime know no OpenCL. A public header belongs to the lowest layer that implements it
# (host/LAYER/STEM.cpp); one without a source of its own to the highest layer among what it includes.
# usage: scripts/check_layers.sh
set -euo pipefail
cd "$(dirname "$0")/.."

layers="common scene influence tree_image io runtime primitives bounds volumes layout metrics build traverse render cli"
# Kernels know of areas what needs boxes.
kernel_layers="shared runtime primitives bounds influence volumes layout metrics build traverse render"

# shellcheck disable=SC2016 # $1 is awk's
find cl host include -name '*.cl' -o -name '*.h' -o -name '*.cpp' -o -name '*.hpp' | sort |
    xargs awk -v layers="$layers" -v kernel_layers="$kernel_layers" '
    BEGIN {
        count = split(layers, names, " ")
        for (i = 1; i <= count; i++) rank[names[i]] = i
        kernel_count = split(kernel_layers, kernel_names, " ")
        for (i = 1; i <= kernel_count; i++) kernel_rank[kernel_names[i]] = i
    }
    FNR == 1 { files[++file_count] = FILENAME }
    /^[ \t]*#[ \t]*include[ \t]*[<"]/ {
        split($0, quoted, /[<">]/)
        includes[FILENAME, ++include_count[FILENAME]] = quoted[2]
        line[FILENAME, include_count[FILENAME]] = FNR
    }

    # The rank of an included file: 0 where no layer holds it.
    function rank_of(path, parts) {
        if (path ~ /^CL\//) return rank["runtime"]
        split(path, parts, "/")
        if (parts[1] == "boxwood") return header_rank("include/" path)
        return parts[1] in rank ? rank[parts[1]] : 0
    }
    function header_rank(header, i, r, stem) {
        if (header in known) return known[header]
        stem = header
        gsub(/.*\/|\.hpp$/, "", stem)
        known[header] = implemented[stem]
        if (!known[header])
            for (i = 1; i <= include_count[header]; i++) {
                r = rank_of(includes[header, i])
                if (r > known[header]) known[header] = r
            }
        return known[header]
    }
    # The layer of a file, 0 for one of none.
    function own_rank(file, parts) {
        split(file, parts, "/")
        if (parts[1] == "include") return file == "include/boxwood/boxwood.hpp" ? 0 : header_rank(file)
        return parts[1] == "cl" ? kernel_rank[parts[2]] : rank[parts[2]]
    }
    function upward(file, own, path, parts) {
        split(path, parts, "/")
        return file ~ /^cl\// ? kernel_rank[parts[1]] > own : rank_of(path) > own
    }

    END {
        for (f = 1; f <= file_count; f++) {
            if (split(files[f], parts, "/") != 3 || parts[1] != "host" || parts[3] !~ /\.cpp$/) continue
            stem = substr(parts[3], 1, length(parts[3]) - 4)
            if (parts[2] == "cli") continue
            if (!(parts[2] in rank)) {
                print "check_layers: no layer is called " parts[2] ": " files[f]
                bad++
                continue
            }
            if (!implemented[stem] || rank[parts[2]] < implemented[stem]) implemented[stem] = rank[parts[2]]
        }
        for (f = 1; f <= file_count; f++) {
            own = own_rank(files[f])
            for (i = 1; own && i <= include_count[files[f]]; i++) {
                included = includes[files[f], i]
                if (!upward(files[f], own, included)) continue
                printf "check_layers: %s:%d includes %s, of a layer above\n", files[f], line[files[f], i], included
                bad++
            }
        }
        printf "check_layers: %d files, %d includes of a layer above\n", file_count, bad
        exit bad > 0 || file_count == 0
    }'
