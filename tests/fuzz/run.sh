#!/usr/bin/env bash
# run.sh [SECONDS] [FOLDER]: builds the fuzz targets with clang and runs each for so long (default 600), from
# small files of the shared data and a few hand-made ones. What it finds is left in FOLDER (default out/fuzz).
set -euo pipefail
cd "$(dirname "$0")/../.."
seconds=${1:-600}
folder=${2:-out/fuzz}
data=${TAUT_DATA:-../shared/data}
mkdir -p "$folder/corpus"
cmake -S . -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=clang++ -DTAUT_FUZZ=ON \
    -DTAUT_BUILD_TESTS=OFF -DTAUT_BUILD_EXAMPLES=OFF > "$folder/build.log"
cmake --build "$folder/build" --target fuzz_matrix_market >> "$folder/build.log"
for file in "$data"/matrices/*.mtx; do
    [ -f "$file" ] && [ "$(stat -c %s "$file")" -lt 8000 ] && cp -f "$file" "$folder/corpus/"
done
printf '%%%%MatrixMarket matrix array real general\n2 3\n1\n2\n3e5\n0\n-5\n6\n' > "$folder/corpus/dense"
printf '%%%%MatrixMarket matrix coordinate real general\n1 1 2\n1 1 1e308\n1 1 1e308\n' > "$folder/corpus/overflow"
for words in "coordinate real general" "coordinate integer symmetric" "coordinate real skew-symmetric"; do
    printf '%%%%MatrixMarket matrix %s\n%% seed\n3 3 2\n2 1 7\n3 2 -5\n' "$words" > "$folder/corpus/${words// /_}"
done
printf '%%%%MatrixMarket matrix coordinate pattern symmetric\n2 2 2\n1 1\n2 1\n' > "$folder/corpus/pattern"
printf '%%%%MatrixMarket matrix array real symmetric\n2 2\n1e-400\n2.5\n+3\n' > "$folder/corpus/array"
chmod -R u+w "$folder/corpus"
"$folder/build/tests/fuzz/fuzz_matrix_market" -max_total_time="$seconds" -max_len=4096 -rss_limit_mb=1024 \
    -malloc_limit_mb=256 -timeout=10 -print_final_stats=1 -dict=tests/fuzz/matrix_market.dict \
    -artifact_prefix="$folder/" "$folder/corpus"
