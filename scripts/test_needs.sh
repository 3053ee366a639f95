#!/usr/bin/env bash
# The tests open reports in a real browser and render through EGL: install both where this may be done, else say how.
set -euo pipefail

missing=()
browser=
for name in chromium chromium-browser google-chrome; do
    command -v "$name" >/dev/null && browser=$name && break
done
[ -n "$browser" ] || missing+=(chromium)
[ "$(uname)" = Linux ] && ! ldconfig -p 2>/dev/null | grep -q 'libEGL\.so\.1' && missing+=(libegl1 libopengl0 libgl1-mesa-dri)

if [ ${#missing[@]} -gt 0 ]; then
    if [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null; then
        apt-get update -qq
        DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
    else
        echo "error: the tests need ${missing[*]}; on Debian: sudo apt-get install ${missing[*]}" >&2
        exit 1
    fi
fi
