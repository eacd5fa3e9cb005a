#!/bin/bash
# Called by the decks between their runs: appends the CPU seconds that the engine above has used.
process=$PPID
for _ in 1 2 3 4; do
  case $(cat /proc/$process/comm) in
    lmp* | ligg*)
      awk '{print ($14+$15)/100}' /proc/$process/stat >> "$CPU_FILE"
      exit
      ;;
  esac
  process=$(awk '/PPid/{print $2}' /proc/$process/status)
done
