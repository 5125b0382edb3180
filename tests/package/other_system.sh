#!/usr/bin/env bash
# This tree on another Debian, or on Ubuntu: a fresh root of that release, a copy of what is committed, and there `./dev test`.
#   tests/package/other_system.sh trixie|noble [FOLDER]
# FOLDER is kept, with the system in it, to be looked at. Needs root, mmdebstrap and the network, and some 30 minutes on two cores.
set -euo pipefail
release=$1
here=$(realpath "$(dirname "$0")/../..")
case $release in
  bookworm | trixie) sources=(http://deb.debian.org/debian) ;;
  noble) sources=("deb [trusted=yes] http://archive.ubuntu.com/ubuntu noble main universe") ;;  # its keys are not in Debian
  *) printf 'other_system: bookworm, trixie or noble, not %s\n' "$release" >&2; exit 2 ;;
esac
if [[ -n ${2:-} ]]; then
  mkdir -p "$2"
  folder=$(realpath "$2")
  trap 'umount "$folder/system/proc" "$folder/system/dev/pts" "$folder/system/dev" 2>/dev/null || true' EXIT
else
  folder=$(mktemp -d)
  trap 'umount "$folder/system/proc" "$folder/system/dev/pts" "$folder/system/dev" 2>/dev/null || true; rm -rf --one-file-system "$folder"' EXIT
fi
root=$folder/system

[[ -e $root/usr/bin ]] ||
  mmdebstrap --quiet --variant=minbase --mode=root --include=ca-certificates --skip=cleanup/apt/lists "$release" "$root" "${sources[@]}"
for file in /etc/resolv.conf /etc/hosts; do [[ ! -f $file ]] || cp -L "$file" "$root$file"; done
grep -rhi proxy /etc/apt/apt.conf /etc/apt/apt.conf.d 2>/dev/null >"$root/etc/apt/apt.conf.d/99proxy" || true
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
mount --bind /dev/pts "$root/dev/pts" # of terminals that tests open

rm -rf "$root/src"
mkdir -p "$root/src/chainreel"
git -C "$here" archive HEAD | tar -x -C "$root/src/chainreel"
chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 sh -c 'cd /src/chainreel && ./dev test'
