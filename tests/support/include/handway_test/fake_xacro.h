#pragma once

#include "handway_test/paths.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace handway::test {

/// A program `xacro` on the PATH during the lifetime of this object. It replaces `$(arg NAME)` by
/// the values on its command line or by the defaults of `<xacro:arg name="…" default="…"/>`, each
/// on a line of its own, and `$(find NAME)` by the folder of a package that programs of ROS 1 and 2
/// would find. It fails if an argument or a package is missing.
class FakeXacro {
 public:
  FakeXacro() : path_before_(std::getenv("PATH")) {
    const std::filesystem::path program = folder_.path() / "xacro";
    std::ofstream(program) << R"sh(#!/bin/sh
file=$1
shift
text=$(sed '/<xacro:arg/d' "$file")
defaults=$(sed -n 's|.*<xacro:arg name="\([^"]*\)" default="\([^"]*\)".*|\1:=\2|p' "$file")
for argument in "$@" $defaults; do
  text=$(printf '%s\n' "$text" | sed "s|\$(arg ${argument%%:=*})|${argument#*:=}|g")
done
for package in $(sed -n 's|.*\$(find \([a-z_]*\)).*|\1|p' "$file" | sort -u); do
  prefix=${AMENT_PREFIX_PATH%%:*}
  if ! [ -e "$prefix/share/ament_index/resource_index/packages/$package" ] ||
     ! grep -q "<name> *$package *</name>" "${ROS_PACKAGE_PATH%%:*}/$package/package.xml"; then
    echo "package '$package' not found" >&2
    exit 2
  fi
  text=$(printf '%s\n' "$text" | sed "s|\$(find $package)|$prefix/share/$package|g")
done
case $text in *'$(arg '*) echo 'Undefined substitution argument' >&2; exit 2;; esac
printf '%s\n' "$text"
)sh";
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    ::setenv("PATH", (folder_.path().string() + ":" + path_before_).c_str(), 1);
  }
  ~FakeXacro() { ::setenv("PATH", path_before_.c_str(), 1); }
  FakeXacro(const FakeXacro&) = delete;
  FakeXacro& operator=(const FakeXacro&) = delete;

 private:
  ScratchFolder folder_;
  std::string path_before_;
};

/// A robot of one link `(prefix)base` with a box of a size that is an argument, m.
inline const std::string kXacroBox =
    "<robot name=\"$(arg prefix)box\" xmlns:xacro=\"http://ros.org/wiki/xacro\">\n"
    "<xacro:arg name=\"prefix\" default=\"left_\"/>\n"
    "<xacro:arg name=\"size\" default=\"0.1\"/>\n"
    "<link name=\"$(arg prefix)base\"><collision><geometry>\n"
    "<box size=\"$(arg size) 0.1 0.1\"/></geometry></collision></link>\n"
    "</robot>\n";

}  // namespace handway::test
