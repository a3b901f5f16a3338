#!/bin/bash
# The horizon study as an array of Slurm jobs that share a folder, and a last one that collects. From the root of the repository:
#
#   job=$(sbatch --parsable --array=1-5 cases/horizon-study/slurm.sh)
#   sbatch --dependency=afterany:$job cases/horizon-study/slurm.sh collect
#
# Repeat both lines for whatever was stopped or failed: what is done is not done again.
#SBATCH --job-name=horizon-study
#SBATCH --cpus-per-task=4
#SBATCH --mem=4G
#SBATCH --time=00:30:00
set -euo pipefail

ligament=${LIGAMENT:-target/release/ligament}
study=${STUDY:-cases/horizon-study/study.toml}
out=${OUT:-results/horizon-study}

if [ "${1:-}" = collect ]; then
    exec "$ligament" sweep "$study" --out "$out" --collect
fi

# Slurm tells the memory of a job in MiB; a tenth is left for the program that starts the runs.
memory=$(awk -v mebibytes="${SLURM_MEM_PER_NODE:?run this by sbatch}" 'BEGIN { printf "%.3f", 0.9 * mebibytes * 1.048576e-3 }')
exec "$ligament" sweep "$study" --out "$out" \
    --shard "${SLURM_ARRAY_TASK_ID:?give sbatch an --array=1-N}/${SLURM_ARRAY_TASK_COUNT}" \
    --jobs "${SLURM_CPUS_PER_TASK:-1}" --memory "$memory"
