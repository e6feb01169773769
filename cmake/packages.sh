# shellcheck shell=bash disable=SC2034
# The Debian and Ubuntu packages that Curlew needs: the one list, sourced by app/demo and tests/run through setup.sh.

# The program: compiler and tools, libraries, what draws without a GPU, what makes videos.
build_packages=(
  g++ cmake ninja-build pkg-config ccache mold
  libeigen3-dev nlohmann-json3-dev libcli11-dev libxxhash-dev libzstd-dev libstb-dev
  python3-glad
  libegl-dev libegl1 libegl-mesa0 libgl1-mesa-dri
  ffmpeg
)
gui_packages=(libglfw3-dev libimgui-dev libgl1 libglx-mesa0 fonts-dejavu-core)
test_packages=(git catch2 libbenchmark-dev xvfb xauth xdotool)  # the last three: a real window on a virtual screen
all_test_packages=(clang libomp-dev libclang-rt-dev)  # for tests/run --all: the second compiler, the thread sanitizer
