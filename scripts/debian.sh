# Installing on Debian and its kin.

as_root() {
  if [[ $(id -u) -eq 0 ]]; then
    "$@"
  else
    sudo "$@"
  fi
}

apt_install() {
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
    -o Dpkg::Use-Pty=0 "$@" >/dev/null
}

install_debian_packages() {
  if [[ $(id -u) -ne 0 ]] && ! have sudo; then
    [[ $# -eq 0 ]] || die "run this as root, then again: apt-get install $*"
    return 0
  fi
  local newer_mesa=no
  wants_newer_mesa "$@" && newer_mesa=yes
  [[ $newer_mesa == yes || $# -gt 0 ]] || return 0
  as_root apt-get update -qq || say 'apt-get update failed; going on with the lists there are'
  if [[ $newer_mesa == yes ]]; then
    install_newer_mesa || say "no newer Mesa to be had from backports; the release's own will do"
  fi
  [[ $# -gt 0 ]] || return 0
  say "installing $*"
  apt_install "$@"
}

# Debian 12 ships Mesa 22.3, which renders about half as fast as 25.0 in its backports and ends any loop at
# 65,535 turns.
codename() { (. /etc/os-release && echo "${VERSION_CODENAME:-}"); }
no_newer_mesa=target/no-newer-mesa

wants_newer_mesa() {
  local version
  version=$(dpkg-query -W -f '${Version}' mesa-vulkan-drivers 2>/dev/null) || version=
  [[ $(codename) == bookworm && $version != *bpo* && ! -e $no_newer_mesa ]] || return 1
  # Neither there nor asked for: another driver renders here.
  [[ -n $version || " $* " == *' mesa-vulkan-drivers '* ]]
}

# The suite is asked for on the mirror that the machine's own entry names, and without leaving a source behind.
# Where it cannot be had, a mark keeps the next run from asking again.
install_newer_mesa() {
  local folder
  folder=$(mktemp -d)
  if ! mesa_from_backports "$folder"; then
    mkdir -p target
    touch "$no_newer_mesa"
  fi
  rm -rf "$folder"
  [[ ! -e $no_newer_mesa ]]
}

mesa_from_backports() {
  local suite mirror options= folder=$1 keyring=/usr/share/keyrings/debian-archive-keyring.gpg
  suite=$(codename)-backports
  mirror=$(apt-get indextargets --format '$(RELEASE) $(REPO_URI)' 'Created-By: Packages' 2>/dev/null |
    awk -v release="$(codename)" '$1 == release { print $2; exit }')
  [[ -n $mirror ]] || return 1
  [[ ! -e $keyring ]] || options="[signed-by=$keyring] "
  cp -r /etc/apt/sources.list.d/. "$folder"
  echo "deb $options$mirror $suite main" >"$folder/welkin-backports.list"
  chmod -R a+rX "$folder"
  local sources=(-o Dir::Etc::SourceParts="$folder")
  # Some other source may fail; what counts is whether this one came.
  as_root apt-get update -qq "${sources[@]}" >/dev/null 2>&1 || true
  apt-cache "${sources[@]}" madison mesa-vulkan-drivers 2>/dev/null | grep " $suite/" >/dev/null || return 1
  say "installing mesa-vulkan-drivers from $suite"
  apt_install "${sources[@]}" -t "$suite" mesa-vulkan-drivers libvulkan1
}
