#!/usr/bin/env bash
# Measures which lines the tests reach: builds into build-coverage, runs the tests but those in a window, and prints the share
# of lines by folder, with the sources that are reached least. Arguments go to ctest. The shares are lower bounds: where programs
# share a source, libgcov drops its counts when it cannot merge theirs.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
command -v gcovr >/dev/null || { echo "error: gcovr is missing: apt-get install gcovr" >&2; exit 1; }

cmake --preset coverage >build-coverage.log 2>&1 || { cat build-coverage.log >&2; exit 1; }
rm build-coverage.log
cmake --build --preset coverage
find build-coverage -name '*.gcda' -delete
status=0
ctest --test-dir build-coverage --parallel "$(nproc)" --label-exclude window --timeout 1800 "$@" >build-coverage/tests.log || status=$?
((status == 0)) || tail -n 20 build-coverage/tests.log
gcovr --root . --object-directory build-coverage --filter geometry/ --filter mesher/ --exclude-throw-branches \
  --gcov-ignore-parse-errors --json-summary-pretty --json-summary build-coverage/summary.json >/dev/null
/usr/bin/python3 - <<'END'
import collections, json
files = json.load(open("build-coverage/summary.json"))["files"]
folders = collections.defaultdict(lambda: [0, 0])
for file in files:
    for folder in ("/".join(file["filename"].split("/")[:2]), "all"):
        folders[folder][0] += file["line_covered"]
        folders[folder][1] += file["line_total"]
for folder, (covered, lines) in sorted(folders.items()):
    print(f"{folder:24} {100 * covered / max(lines, 1):5.1f} % of {lines} lines")
print("reached least:")
for file in sorted((f for f in files if f["line_total"] > 20), key=lambda f: f["line_percent"])[:12]:
    print(f"  {file['filename']:44} {file['line_percent']:5.1f} %")
END
exit "$status"
