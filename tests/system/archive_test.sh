#!/bin/sh
# archive_test.sh SOURCE_DIR BUILD_DIR: what `cpack` packs for other systems runs on the libraries that it brings.
# scripts/try_archive does the same on older releases.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cpack --config "$2/CPackConfig.cmake" -G TGZ -B "$folder" >"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }
"$1/tests/system/check_archive.sh" "$folder"/talus-*.tar.gz
