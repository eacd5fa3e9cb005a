// The journal's tables.
#pragma once

namespace talus::journal {

// "talu", so that `file` and we tell a journal from another SQLite file.
inline constexpr int kJournalApplicationId = 0x74616c75;
// Grows with every change of the tables. Journals of another version are refused.
inline constexpr int kSchemaVersion = 8;

inline constexpr const char* kSchema = R"sql(
CREATE TABLE campaign (
  id INTEGER PRIMARY KEY CHECK (id = 1),
  name TEXT NOT NULL,
  spec_path TEXT NOT NULL,
  spec_text TEXT NOT NULL,
  spec_json TEXT NOT NULL,
  spec_hash TEXT NOT NULL,
  talus_version TEXT NOT NULL,
  created_utc TEXT NOT NULL,
  objective TEXT NOT NULL,
  state TEXT NOT NULL,
  stop_reason TEXT NOT NULL,
  elapsed_s REAL NOT NULL,
  result_json TEXT NOT NULL,
  stop_json TEXT NOT NULL
);
CREATE TABLE parameters (
  position INTEGER PRIMARY KEY,   -- order in the unit cube, from 0
  name TEXT NOT NULL UNIQUE,
  low REAL NOT NULL,
  high REAL NOT NULL,
  scale TEXT NOT NULL,
  unit TEXT NOT NULL              -- SI unit of low, high and every value of it
);
CREATE TABLE experiments (
  position INTEGER PRIMARY KEY,   -- from 0
  name TEXT NOT NULL UNIQUE,
  aehp_png BLOB NOT NULL,
  aehp_sd_png BLOB NOT NULL,
  frame_json TEXT NOT NULL,
  aehp_nebp_px REAL,
  num_heaps INTEGER NOT NULL,     -- the AEHP is the mean of
  experimental_noise_floor_mm2 REAL
);
CREATE TABLE experiment_runs (    -- images of the single heaps, in the frame of their mean
  experiment INTEGER NOT NULL REFERENCES experiments(position),
  position INTEGER NOT NULL,
  name TEXT NOT NULL,
  png BLOB NOT NULL,
  PRIMARY KEY (experiment, position)
);
CREATE TABLE experiment_scalars (
  experiment INTEGER NOT NULL REFERENCES experiments(position),
  position INTEGER NOT NULL,
  name TEXT NOT NULL,             -- of the trials' metric, with the unit: mass_fallen_kg
  value REAL NOT NULL,
  standard_error REAL NOT NULL,
  degrees_of_freedom INTEGER NOT NULL,  -- of the error; 0: it was stated
  PRIMARY KEY (experiment, position)
) WITHOUT ROWID;
CREATE TABLE experiment_warnings (
  experiment INTEGER NOT NULL REFERENCES experiments(position),
  position INTEGER NOT NULL,
  warning_json TEXT NOT NULL,
  PRIMARY KEY (experiment, position)
) WITHOUT ROWID;
CREATE TABLE reference_metrics (  -- of the experiments themselves
  experiment INTEGER NOT NULL REFERENCES experiments(position),
  position INTEGER NOT NULL,
  name TEXT NOT NULL,             -- with the unit: repose_angle_1_mean_deg
  value REAL,                     -- NULL when not defined
  unit TEXT NOT NULL,
  undefined TEXT NOT NULL,        -- why it is not defined
  standard_error REAL,            -- NULL when nothing tells it
  PRIMARY KEY (experiment, position)
) WITHOUT ROWID;
CREATE TABLE trials (
  id INTEGER PRIMARY KEY,         -- from 1; the folder is trials/0001
  kind TEXT NOT NULL,             -- noise, design, search, confirm, reused
  kind_index INTEGER NOT NULL,
  set_index INTEGER NOT NULL,     -- replicates of one point share it
  origin TEXT NOT NULL,
  objective TEXT NOT NULL,
  seed INTEGER NOT NULL,
  scale_factor REAL NOT NULL,
  status TEXT NOT NULL,           -- running, ok, failed
  reason TEXT NOT NULL,
  attempts INTEGER NOT NULL,
  finish_order INTEGER NOT NULL,  -- order in which trials were told to the optimiser; 0 while running
  due REAL NOT NULL,              -- when it is to be told, by expected costs [core s]
  started_utc TEXT NOT NULL,
  finished_utc TEXT NOT NULL,
  duration_s REAL,
  cpu_s REAL,
  num_steps INTEGER NOT NULL,
  num_particles INTEGER NOT NULL,
  host TEXT NOT NULL,
  job TEXT NOT NULL,
  experiment INTEGER NOT NULL REFERENCES experiments(position)
);
CREATE TABLE points (
  trial INTEGER NOT NULL REFERENCES trials(id) ON DELETE CASCADE,
  position INTEGER NOT NULL REFERENCES parameters(position),
  unit_value REAL NOT NULL,       -- in the unit cube
  value REAL NOT NULL,            -- in the SI unit that parameters.unit names
  PRIMARY KEY (trial, position)
) WITHOUT ROWID;
CREATE TABLE metrics (
  trial INTEGER NOT NULL REFERENCES trials(id) ON DELETE CASCADE,
  name TEXT NOT NULL,             -- with the unit: sad_mm2
  value REAL,                     -- NULL when not defined
  unit TEXT NOT NULL,
  undefined TEXT NOT NULL,        -- why it is not defined
  PRIMARY KEY (trial, name)
) WITHOUT ROWID;
CREATE TABLE profiles (
  trial INTEGER PRIMARY KEY REFERENCES trials(id) ON DELETE CASCADE,
  png BLOB NOT NULL,
  checksum_xxh3 TEXT NOT NULL
);
CREATE TABLE events (
  id INTEGER PRIMARY KEY,
  utc TEXT NOT NULL,
  kind TEXT NOT NULL,
  trial INTEGER NOT NULL,
  text TEXT NOT NULL
);
CREATE TABLE checksums (  -- see checksums.h
  id INTEGER PRIMARY KEY,  -- of the trial; 0 for the campaign
  xxh3 TEXT NOT NULL
);
)sql";

}  // namespace talus::journal
