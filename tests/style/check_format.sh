#!/bin/sh
# check_format.sh SOURCE_DIR: fails when clang-format would change a C++ file.
set -eu
cd "$1"
find base engine imaging surrogate optimizer experiments python tests bench \
  \( -name '*.h' -o -name '*.cc' \) -print0 | xargs -0 clang-format --dry-run -Werror
