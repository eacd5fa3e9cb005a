#!/bin/sh
# install_test.sh SOURCE_DIR BINARY_DIR: what `cmake --install` puts in place is enough to run the
# program and to build another one with find_package(talus).
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$2" --prefix "$work/prefix" >"$work/log" || { cat "$work/log"; exit 1; }
"$work/prefix/bin/talus" --version
share="$work/prefix/share"
for file in man/man1/talus.1 man/man1/talus-calibrate.1 bash-completion/completions/talus \
    zsh/site-functions/_talus fish/vendor_completions.d/talus.fish doc/talus/LICENSE; do
  test -s "$share/$file" || { echo "$file is missing"; exit 1; }
done
for example in "$share"/talus/examples/*/campaign.json; do
  schema=$(sed -n 's/.*"$schema": "\([^"]*\)".*/\1/p' "$example")
  test -s "$(dirname "$example")/$schema" || { echo "$example: $schema does not resolve"; exit 1; }
done
cmake -S "$1/tests/system/consumer" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" \
  -DCMAKE_BUILD_TYPE=Release >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
cmake --build "$work/build" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
"$work/build/consumer"
