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
    zsh/site-functions/_talus fish/vendor_completions.d/talus.fish doc/talus/LICENSE doc/talus/copyright; do
  test -s "$share/$file" || { echo "$file is missing"; exit 1; }
done
for example in "$share"/talus/examples/*/campaign.json; do
  schema=$(sed -n 's/.*"$schema": "\([^"]*\)".*/\1/p' "$example")
  test -s "$(dirname "$example")/$schema" || { echo "$example: $schema does not resolve"; exit 1; }
done
python3 - "$share/talus" <<'END' || exit 1
import pathlib, re, sys
root = pathlib.Path(sys.argv[1])
dead = [f"{page.relative_to(root)}: {link}" for page in sorted(root.rglob("*.md"))
        for link in re.findall(r"\]\(([^)#\s]+)", page.read_text())
        if not re.match(r"\w+:", link) and not (page.parent / link).exists()]
sys.exit("\n".join(["links that lead nowhere once installed:", *dead]) if dead else 0)
END
# build SOURCE NAME: configures and builds a project against the installed package, in $work/NAME.
build() {
  cmake -S "$1" -B "$work/$2" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release \
    >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
  cmake --build "$work/$2" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
}
# prints PATTERN PROGRAM: the program ends well and a line it prints matches.
prints() {
  "$2" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
  cat "$work/log"
  grep -Eq "$1" "$work/log" || { echo "$2 does not print $1"; exit 1; }
}
build "$1/tests/system/headers" headers
build "$share/talus/examples/library" library
prints '^200 grains, [1-9][0-9]* contacts' "$work/library/simulate_scene"
prints '^sad_px: [1-9]' "$work/library/compare_profiles"
prints '^after [1-9][0-9]* evaluations: +0\.(2[5-9]|3[0-5])[0-9]* +0\.(6[5-9]|7[0-5])' \
  "$work/library/ask_tell"
