#!/bin/sh
# check_package.sh DEB: what the package unpacks runs, finds its examples' schemas and has its man pages,
# and every library that the program needs belongs to a package that it depends on.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
dpkg-deb -x "$1" "$work"
depends=$(dpkg-deb -f "$1" Depends)
"$work/usr/bin/talus" --version
"$work/usr/bin/talus" validate "$work/usr/share/talus/examples/demo/campaign.json" >"$work/log"
test -s "$work/usr/share/talus/docs/campaign.schema.json"
test -s "$work/usr/share/man/man1/talus-calibrate.1"
grep -q 'ECharts-GL' "$work/usr/share/doc/talus/copyright"
objdump -p "$work/usr/bin/talus" | sed -n 's/^ *NEEDED *//p' | while read -r library; do
  path=$(ldd "$work/usr/bin/talus" | sed -n "s|.*$library => \([^ ]*\) .*|\1|p")
  [ -n "$path" ] || continue  # the loader itself
  case "$depends" in *"| $library"*) continue ;; esac  # any of the packages that provide it
  file=$(realpath "$path")  # dpkg knows some of /usr/lib as /lib
  package=$({ dpkg -S "$file" || dpkg -S "${file#/usr}"; } 2>/dev/null | head -1 | cut -d: -f1)
  case ", $depends" in
    *", $package "* | *", $package,"* | *", $package") ;;
    *) echo "$library is of $package, which the package does not depend on: $depends"; exit 1 ;;
  esac
done
echo "$1 is complete"
