#!/bin/sh
# Prints a Python that can make the environment, or says in one line what is in the way.
#
#   find_python.sh VENV [PYTHON]
#
# VENV: folder of the environment, made or not. PYTHON: taken instead of looking for one.

NEEDED="3.11 or 3.12 (numpy < 2 has no wheels for 3.13)"
venv=$1
wanted=$2

stop() { echo "make: $*" >&2; exit 1; }

# "3.12.1", or nothing where the command does not start (a shim that points nowhere).
version() {
    "$1" -c 'import sys; print("%d.%d.%d" % sys.version_info[:3])' 2>/dev/null
}

fits() { case $1 in 3.11.* | 3.12.*) ;; *) return 1 ;; esac; }

# Debian keeps what `python -m venv` needs in a package of its own.
makes_environments() { "$1" -c 'import ensurepip, venv' >/dev/null 2>&1; }

if [ -e "$venv/bin/python" ] || [ -L "$venv/bin/python" ]; then
    has=$(version "$venv/bin/python")
    fits "$has" || stop "$venv holds Python ${has:-that does not start}," \
        "needed is $NEEDED: 'make clean', then make again"
    if [ -n "$wanted" ] && [ "$(version "$wanted")" != "$has" ]; then
        stop "$venv holds Python $has, PYTHON=$wanted" \
            "is $(version "$wanted" || echo none): 'make clean', then make again"
    fi
fi

found=
for candidate in ${wanted:-python3.12 python3.11 python3 python}; do
    place=$(command -v "$candidate") || continue
    has=$(version "$place")
    if ! fits "$has"; then
        found="$found $place (${has:-does not start})"
    elif ! makes_environments "$place"; then
        found="$found $place ($has, without venv: install python${has%.*}-venv)"
    else
        echo "$place"
        exit 0
    fi
done
stop "needed is Python $NEEDED, found${found:- none}; name one: make PYTHON=/path/to/python"
