// The journal's tables, as a list of steps from one version of the schema to the next. A step that
// has been released is never edited: a change is a new step.
#pragma once

#include <array>

namespace talus::journal {

// "talu", so that `file` and we tell a journal from another SQLite file.
inline constexpr int kJournalApplicationId = 0x74616c75;

inline constexpr const char* kSchemaVersion1 = R"sql(
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
  aehp_png BLOB NOT NULL,
  aehp_sd_png BLOB NOT NULL,
  frame_json TEXT NOT NULL,
  aehp_nebp_px REAL,
  experimental_noise_floor_mm2 REAL,
  state TEXT NOT NULL,
  stop_reason TEXT NOT NULL,
  elapsed_s REAL NOT NULL,
  result_json TEXT NOT NULL
);
CREATE TABLE parameters (
  position INTEGER PRIMARY KEY,   -- order in the unit cube, from 0
  name TEXT NOT NULL UNIQUE,
  low REAL NOT NULL,
  high REAL NOT NULL,
  scale TEXT NOT NULL,
  unit TEXT NOT NULL              -- SI unit of low, high and every value of it
);
CREATE TABLE reference_metrics (  -- of the experiment itself
  position INTEGER PRIMARY KEY,
  name TEXT NOT NULL UNIQUE,      -- with the unit: repose_angle_1_mean_deg
  value REAL,                     -- NULL when not defined
  unit TEXT NOT NULL,
  undefined TEXT NOT NULL         -- why it is not defined
);
CREATE TABLE trials (
  id INTEGER PRIMARY KEY,         -- from 1; the folder is trials/0001
  kind TEXT NOT NULL,             -- noise, design, search, confirm
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
  started_utc TEXT NOT NULL,
  finished_utc TEXT NOT NULL,
  duration_s REAL,
  cpu_s REAL,
  num_steps INTEGER NOT NULL,
  num_particles INTEGER NOT NULL,
  host TEXT NOT NULL,
  job TEXT NOT NULL
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
)sql";

inline constexpr const char* kSchemaVersion2 = R"sql(
ALTER TABLE campaign ADD COLUMN num_heaps INTEGER NOT NULL DEFAULT 1;  -- the AEHP is the mean of
ALTER TABLE reference_metrics ADD COLUMN standard_error REAL;          -- NULL when nothing tells it
)sql";

// Several experiments in a campaign, the runs that each is the mean of, and numbers with errors.
inline constexpr const char* kSchemaVersion3 = R"sql(
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
INSERT INTO experiments
  SELECT 0, 'heap', aehp_png, aehp_sd_png, frame_json, aehp_nebp_px, num_heaps,
         experimental_noise_floor_mm2 FROM campaign;
ALTER TABLE campaign DROP COLUMN aehp_png;
ALTER TABLE campaign DROP COLUMN aehp_sd_png;
ALTER TABLE campaign DROP COLUMN frame_json;
ALTER TABLE campaign DROP COLUMN aehp_nebp_px;
ALTER TABLE campaign DROP COLUMN num_heaps;
ALTER TABLE campaign DROP COLUMN experimental_noise_floor_mm2;
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
  PRIMARY KEY (experiment, position)
) WITHOUT ROWID;
ALTER TABLE reference_metrics RENAME TO reference_metrics_2;
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
INSERT INTO reference_metrics
  SELECT 0, position, name, value, unit, undefined, standard_error FROM reference_metrics_2;
DROP TABLE reference_metrics_2;
ALTER TABLE trials ADD COLUMN experiment INTEGER NOT NULL DEFAULT 0;
)sql";

inline constexpr const char* kSchemaVersion4 = R"sql(
CREATE TABLE checksums (  -- see checksums.h; written again after every step to a later version
  id INTEGER PRIMARY KEY,  -- of the trial; 0 for the campaign
  xxh3 TEXT NOT NULL
);
)sql";

// What is doubtful about the photographs, which reports show, stood among the events, which have no
// checksum: nothing is made of them.
inline constexpr const char* kSchemaVersion5 = R"sql(
CREATE TABLE experiment_warnings (
  experiment INTEGER NOT NULL REFERENCES experiments(position),
  position INTEGER NOT NULL,
  warning_json TEXT NOT NULL,
  PRIMARY KEY (experiment, position)
) WITHOUT ROWID;
INSERT INTO experiment_warnings SELECT trial, id, text FROM events WHERE kind = 'photograph';
DELETE FROM events WHERE kind = 'photograph';
)sql";

inline constexpr std::array kSchemaSteps{kSchemaVersion1, kSchemaVersion2, kSchemaVersion3,
                                         kSchemaVersion4, kSchemaVersion5};

}  // namespace talus::journal
