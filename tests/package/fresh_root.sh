#!/usr/bin/env bash
# The Debian package in a system that has nothing of it: installed by apt with its dependencies alone, it makes a film, and
# the same numbers as the program that was built here.
#   tests/package/fresh_root.sh build/chainreel out/chainreel.deb
# Needs root, mmdebstrap and the network. Says how long it took from `apt install` to the first film.
set -euo pipefail
program=$(realpath "$1") package=$(realpath "$2")
folder=$(mktemp -d)
root=$folder/root
trap 'umount "$root/proc" 2>/dev/null; rm -rf --one-file-system "$folder"' EXIT

say() { printf 'fresh_root: %s\n' "$*" >&2; }
die() { say "$*"; exit 1; }
inside() { chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/films LC_ALL=C.UTF-8 "$@"; }

# As this system: its release and its sources, no recommended packages.
release=$(. /etc/os-release && echo "$VERSION_CODENAME")
mmdebstrap --quiet --variant=minbase --mode=root --skip=cleanup/apt/lists "$release" "$root" >"$folder/log" 2>&1 ||
  die "no fresh root: $(tail -3 "$folder/log")"
for file in /etc/resolv.conf /etc/hosts; do [[ ! -f $file ]] || cp -L "$file" "$root$file"; done
grep -rhi proxy /etc/apt/apt.conf /etc/apt/apt.conf.d 2>/dev/null >"$root/etc/apt/apt.conf.d/99proxy" || true
mount -t proc proc "$root/proc" 2>/dev/null || say 'without /proc, which cannot be mounted here'
if inside sh -c 'command -v chainreel'; then die "the root is not fresh"; fi

cp "$package" "$root/chainreel.deb"
begin=$(date +%s)
inside env DEBIAN_FRONTEND=noninteractive apt-get -q -y install --no-install-recommends ./chainreel.deb >"$folder/log" 2>&1 ||
  die "apt refuses the package: $(tail -5 "$folder/log")"
installed=$(date +%s)
inside sh -c 'mkdir /films && cd /films && chainreel render rr_free --quiet -o rr_free.mp4 -o rr_free.png'
film=$(date +%s)
grep -h 'Need to get' "$folder/log" >&2 || true
say "apt install: $((installed - begin)) s; the first film and its picture: $((film - installed)) s"
((film - begin <= 60)) || say "NOTE: more than the 60 s that are wanted, on this machine at this time"
[[ -s $root/films/rr_free.mp4 && -s $root/films/rr_free.png ]] || die "no film was written"

# The same motion, bit by bit, as here.
hash_of() { sed -n 's/.*"trajectory_sha256": "\([0-9a-f]*\)".*/\1/p'; }
here=$("$program" simulate rr_free --json -o "$folder/here.csv" | hash_of)
there=$(inside sh -c 'cd /films && chainreel simulate rr_free --json -o there.csv' | hash_of)
[[ ${#here} == 64 && $here == "$there" ]] || die "another motion: '$here' here, '$there' there"
cmp "$folder/here.csv" "$root/films/there.csv"

# What a user does next.
inside sh -c 'cd /films && chainreel init my_arm --links 0.5,0.4 --masses 2,1 && chainreel snapshot my_arm.yaml --at 1 -o my_arm.png'
inside sh -c 'cd /films && chainreel init mine --from pen && chainreel check mine.yaml >/dev/null'
inside chainreel doctor
if [[ -e $root/proc/self/exe ]]; then inside chainreel equations rr.urdf >/dev/null; fi
inside test -f /usr/share/man/man1/chainreel-render.1

# No library is missing, and the package asks for all that is opened by name.
if inside ldd /usr/bin/chainreel | grep 'not found'; then die "a library is missing"; fi
for name in libavcodec libavformat libavutil libswscale libosmesa6 fonts-dejavu-core fonts-lmodern; do
  dpkg-deb -f "$package" Depends | grep -q "$name" || die "the package does not depend on $name"
done

# The scripts of the shells are read by these.
inside env DEBIAN_FRONTEND=noninteractive apt-get -q -y install --no-install-recommends zsh fish man-db >"$folder/log" 2>&1 ||
  die "no shells: $(tail -3 "$folder/log")"
inside zsh -n /usr/share/zsh/vendor-completions/_chainreel
inside fish -c 'complete -C "chainreel rend"' | grep -q '^render' || die "fish does not complete the commands"
inside fish -c 'complete -C "chainreel render --th"' | grep -q '^--theme' || die "fish does not complete options"
inside fish -c 'complete -C "chainreel render --theme d"' | grep -q '^dark' || die "fish does not complete words"
inside man --warnings -E UTF-8 -l -Tutf8 -Z /usr/share/man/man1/chainreel.1 >/dev/null 2>"$folder/log"
[[ ! -s $folder/log ]] || die "the manual page has faults: $(cat "$folder/log")"

# The Python module, where its package was made.
if [[ -f ${package%/*}/python3-chainreel.deb ]]; then
  cp "${package%/*}/python3-chainreel.deb" "$root/"
  inside env DEBIAN_FRONTEND=noninteractive apt-get -q -y install --no-install-recommends ./python3-chainreel.deb >"$folder/log" 2>&1 ||
    die "apt refuses the Python package: $(tail -5 "$folder/log")"
  inside sh -c "cd /films && python3 -B -c 'import chainreel as cr
assert cr.Scene(\"rr_free\", duration=0.5).run().film(\"python.mp4\") == [\"python.mp4\"]'" || die "the Python module does not run"
fi

# Taken away, nothing of it stays.
inside env DEBIAN_FRONTEND=noninteractive apt-get -q -y purge chainreel >/dev/null 2>&1
[[ -z $(find "$root/usr" -name '*chainreel*' -print -quit) ]] || die "something stays behind when the package is taken away"
say "good"
