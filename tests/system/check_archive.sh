#!/bin/sh
# check_archive.sh TGZ: what `cpack` packs for other systems runs from a folder with a space in its name, with no library
# of this system, and its trials do, too. As root, also in a root that has nothing but a shell.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/some where"
tar -xzf "$1" -C "$work/some where" --strip-components=1
home="$work/some where"
"$home/bin/talus" --version
# Each library that the loader opens lies in the archive; it calls itself by the name that programs ask for it by. The
# launcher's shell uses this system's, so that the loader is called as the launcher does.
libraries="$home/lib/talus"
env LD_DEBUG=files OMP_WAIT_POLICY=passive "$libraries"/ld-linux-* --inhibit-cache --library-path "$libraries" \
  "$libraries/talus" --version 2>&1 >/dev/null | sed -n 's/.*calling init: //p' | while read -r library; do
  case "$library" in "$home"/* | */ld-linux-*) ;; *) echo "$library is this system's"; exit 1 ;; esac
done
test -s "$home/share/doc/talus/copyright"
test -s "$home/share/doc/talus/libraries/libc6"  # as of each library
cat >"$work/case.json" <<'CASE'
{"powder": {"sizes": {"kind": "mono", "diameter": "1 mm"}, "mass": "0.3 g", "material": {"density": 2500, "youngs_modulus": "1 MPa"}},
 "frame": {"width_px": 120, "height_px": 80, "pixel_size": 1e-4, "center_x_px": 60, "baseline_px": 70, "plate_diameter": 0.01}}
CASE
"$home/bin/talus" simulate "$work/case.json" --out "$work/heap" --quiet
cat >"$work/spec.json" <<SPEC
{"experiment": {"map": "heap/profile.png", "plate_diameter": "10 mm", "frame": {"width_px": 120, "height_px": 80,
   "pixel_size": 1e-4, "center_x_px": 60, "baseline_px": 70, "plate_diameter": 0.01}},
 "powder": {"sizes": {"kind": "mono", "diameter": "1 mm"}, "mass": "0.3 g", "material": {"density": 2500, "youngs_modulus": "1 MPa"}},
 "parameters": {"sliding_friction": {"min": 0.1, "max": 0.9}}, "strategy": {"kind": "sobol", "num_points": 3},
 "budget": {"simulations": 3}, "confirm": {"candidates": 0}}
SPEC
"$home/bin/talus" calibrate "$work/spec.json" --out "$work/run" --quiet  # a trial is a process of its own
grep -q '"num_failed": 0' "$work/run/result.json"
if [ "$(id -u)" = 0 ] && [ -x /bin/busybox ]; then
  root="$work/root"
  mkdir -p "$root/bin" "$root/tmp"
  cp -r "$home" "$root/talus"
  cp /bin/busybox "$root/bin/busybox"
  for name in sh readlink dirname; do ln -s busybox "$root/bin/$name"; done
  cp "$work/case.json" "$root/tmp/"
  chroot "$root" /bin/sh -c '/talus/bin/talus simulate /tmp/case.json --out /tmp/heap --quiet'
  test -s "$root/tmp/heap/profile.png"
  echo "it runs in a root with nothing but busybox"
fi
echo "$(basename "$1") runs on its own libraries"
