#!/usr/bin/env bash
# Make the virtual environment, also on a bare Debian whose Python comes without venv.
set -euo pipefail
folder=$1
python=${PYTHON:-python3}

[ -x "$folder/bin/python" ] && "$folder/bin/python" -m pip --version >/dev/null 2>&1 && exit 0
if ! command -v "$python" >/dev/null; then
    echo "error: $python not found; install Python 3.11 or newer, or call make with PYTHON=/path/to/python3" >&2
    exit 1
fi
if ! "$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))'; then
    echo "error: $("$python" --version) is too old; susp_mj needs Python 3.11 or newer (make PYTHON=/path/to/python3.11)" >&2
    exit 1
fi
rm -rf "$folder"
"$python" -m venv "$folder" >/dev/null 2>&1 && exit 0
rm -rf "$folder"
if [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null; then
    apt-get update -qq
    apt-get install -y -qq --no-install-recommends python3-venv >/dev/null
    "$python" -m venv "$folder"
else
    echo "error: $python cannot make virtual environments; on Debian or Ubuntu: sudo apt-get install python3-venv" >&2
    exit 1
fi
