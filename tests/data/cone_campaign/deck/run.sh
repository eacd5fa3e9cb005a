awk -v mu={{ sliding_friction }} -v mr={{ rolling_friction }} 'BEGIN {
  print "x,y,z,r"
  for (x = -4; x <= 4; ++x) for (y = -4; y <= 4; ++y) if (x * x + y * y <= 16)
    for (z = 0.5; z <= 1 + (4 - sqrt(x * x + y * y)) * (0.4 + mu + 0.3 * mr); ++z)
      print x * 1e-3 "," y * 1e-3 "," z * 1e-3 ",5.1e-4"
}' >heap.csv
