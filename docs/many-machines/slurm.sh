#!/bin/sh
# A turntable by a job array of Slurm: each task draws every fourth frame. sbatch slurm.sh
#SBATCH --job-name=vitrine
#SBATCH --array=1-4
#SBATCH --cpus-per-task=2
#SBATCH --requeue
set -eu
# Part and number of parts come from SLURM_ARRAY_TASK_ID and SLURM_ARRAY_TASK_COUNT. A task that is stopped
# and queued again goes on with the frames that are missing.
exec vitrine render "${MODEL:-goblet}" -o "${OUT:-out}/{frame}.png" --turntable 120 --samples 16 --resolution 1024,1024
