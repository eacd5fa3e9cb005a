#!/bin/bash
#SBATCH --array=0-0
#talus batch 12 talus-1f-12
#talus job 7 1 /home/a b/trials/0007
