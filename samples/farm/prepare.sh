#!/usr/bin/env bash
# What bake.sh and bake_local.sh begin with, and source: SCENE.json FOLDER SHARES [words of goffer cache].. It prepares the
# cache, and leaves `scene`, `folder`, `shares`, and in `load` the words that every run of goffer must be given.

fail() { echo "$(basename "$0"): $2" >&2; exit "$1"; }

[[ -f $1 && -r $1 ]] || fail 1 "$1: there is no such scene, or it cannot be read"
[[ -d $(dirname "$2") ]] || fail 1 "$2: the folder that it is to be in does not exist"
[[ $3 =~ ^[1-9][0-9]{0,5}$ ]] || fail 2 "SHARES is '$3'; give a whole number from 1 to 999999"
scene=$(realpath "$1")
folder=$(realpath "$2")
shares=$3
shift 3

# How files are read is each run's own. All else is kept in the plan; what machines would decide each in its own way, as
# `--isa auto`, is decided here.
load=()
for ((i = 1; i <= $#; ++i)); do
    case ${!i} in
        --allow-outside | --max-memory=*) load+=("${!i}") ;;
        --max-memory) load+=("${@:i:2}") ;;
    esac
done

# What is wrong with the scene shows here rather than in every share, and all machines get the same bodies and kernels.
goffer cache "$scene" -o "$folder" --prepare "$@" >&2
