# pkg_config.sh <compiler> <headers' packages> <library's package> <source> <program>
# Builds a program with one plain command line, and runs it. The two packages are the same but where a mismatch is tested.
set -eu
compiler=$1
headers=$("$PKG_CONFIG" --cflags "$2")
library=$("$PKG_CONFIG" --libs "$3")
# Unquoted: each holds several arguments.
"$compiler" -std=c++20 -Wall -Wextra -Wpedantic -Wconversion -Werror $headers "$4" $library -o "$5"
exec "$5"
