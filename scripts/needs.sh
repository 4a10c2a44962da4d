# What the goals need: how to tell that it is there, and Debian's package for it.

have() { command -v "$1" >/dev/null 2>&1; }

has_compiler() { have cc && have make; }
has_pkg_config() { have pkg-config; }
has_node() { have node; }
has_npm() { have npm; }
has_curl() { have curl; }
# As the browser tests look for it.
has_postgres() { have initdb || compgen -G '/usr/lib/postgresql/*/bin/initdb' >/dev/null; }
has_ffmpeg() { have ffmpeg; }
has_pip() { have python3 && python3 -m pip --version >/dev/null 2>&1; }
has_chromium() { [[ -x ${CHROMIUM:-/usr/bin/chromium} ]]; }

# Apple's machines render by Metal, which is always there.
is_mac() { [[ $(uname -s) == Darwin ]]; }
has_vulkan_loader() {
  is_mac || PATH="$PATH:/sbin:/usr/sbin" ldconfig -p 2>/dev/null | grep 'libvulkan\.so\.1' >/dev/null
}
has_driver_file() {
  local folder
  for folder in /usr/share /usr/local/share /etc; do
    compgen -G "$folder/vulkan/icd.d/$1" >/dev/null && return 0
  done
  return 1
}
has_vulkan_driver() { is_mac || [[ -n ${VK_DRIVER_FILES:-${VK_ICD_FILENAMES:-}} ]] || has_driver_file '*.json'; }
# The tests run on Mesa's software Vulkan, so that every machine gets the same pictures.
has_lavapipe() { is_mac || has_driver_file 'lvp_icd*.json'; }

needs_of() {
  echo has_compiler build-essential
  echo has_pkg_config pkg-config
  echo has_vulkan_loader libvulkan1
  if [[ $1 == test ]]; then
    echo has_lavapipe mesa-vulkan-drivers
    echo has_chromium chromium
    echo has_curl curl
    echo has_node nodejs
    echo has_npm npm
    echo has_postgres postgresql
    echo has_ffmpeg ffmpeg
    echo has_pip python3-pip
  else
    echo has_vulkan_driver mesa-vulkan-drivers
  fi
}

words_of() {
  local words='a C compiler with make, pkg-config, the Vulkan loader and a Vulkan driver such as Mesa'\''s lavapipe'
  [[ $1 == test ]] && words+=', Chromium (CHROMIUM holds its path), curl, Node.js and npm, PostgreSQL, ffmpeg, Python with pip'
  echo "$words"
}
