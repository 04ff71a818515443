# Sourced by tools/run, tools/test and tools/bench: installs what is missing and builds a preset. Bash.
# Afterwards $root is the project's folder.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# install_missing_packages LIST: those of tools/LIST.
install_missing_packages() {
  local wanted missing
  wanted=$(sed -e 's/#.*//' -e '/^[[:space:]]*$/d' "$root/tools/$1")
  # Node.js from elsewhere brings its own npm, beside which Debian's cannot be installed.
  ! command -v npm >/dev/null || wanted=$(grep -vx npm <<<"$wanted")
  if ! command -v dpkg-query >/dev/null; then
    echo "tools/setup.sh: this is not Debian; install the like of these packages by hand:" $wanted >&2
    return
  fi
  missing=$(comm -23 <(sort <<<"$wanted") \
    <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' $wanted 2>/dev/null | sed -n 's/^installed //p' | sort -u))
  [ -n "$missing" ] || return 0
  local command="apt-get install -y --no-install-recommends $(tr '\n' ' ' <<<"$missing")"
  if [ "$(id -u)" -ne 0 ]; then
    echo "Some packages are missing. Type this, then start again:" >&2
    echo "  sudo sh -c 'apt-get update && $command'" >&2
    exit 1
  fi
  echo "Installing: $(tr '\n' ' ' <<<"$missing")"
  apt-get update -q
  DEBIAN_FRONTEND=noninteractive $command
  installed=yes
}

# build PRESET [TARGET...]: configures where that was not done, or more is installed since, then builds.
installed=no
build() {
  local preset=$1
  shift
  cd "$root"
  [ "$installed" = no ] && [ -f "build/$preset/build.ninja" ] || cmake --preset "$preset"
  cmake --build --preset "$preset" ${@:+--target "$@"}
  cd "$OLDPWD"
}

install_missing_packages packages.txt
