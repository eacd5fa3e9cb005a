#include "experiments/analysis/card/card.h"

#include <cmath>

#include "base/error.h"
#include "base/text/number_text.h"
#include "base/text/shell_text.h"
#include "engine/bodies/particle.h"
#include "experiments/analysis/card/card_deck.h"
#include "experiments/analysis/card/card_formats.h"
#include "experiments/analysis/card/card_walls.h"
#include "experiments/analysis/predict/draws.h"
#include "experiments/campaign/answer/answer.h"
#include "experiments/campaign/answer/describe_posterior.h"
#include "experiments/campaign/answer/joint_view.h"
#include "experiments/campaign/answer/nuisances.h"
#include "experiments/campaign/folder/folder_in_text.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/journal/journal.h"
#include "experiments/rigs/case/materials.h"
#include "experiments/rigs/case/pairs.h"
#include "experiments/trials/engines/command_case.h"
#include "optimizer/space/point_rows.h"

namespace talus::analysis {
namespace {

// What a campaign has concluded, and what it was asked.
struct Finished {
  campaign::Answer result;
  campaign::CampaignSpec spec;
};

Finished ReadFinished(const std::filesystem::path& folder) {
  journal::Journal journal = journal::Journal::OpenReadOnly(journal::JournalPath(folder));
  const std::string text = journal.Progress().result_json;
  if (text.empty()) {
    throw base::ConfigError(folder.string() + ": has no result yet; `talus status " +
                            base::ShellWord(folder.string()) + "` says where the campaign stands");
  }
  return {.result = campaign::ParseAnswer(text),
          .spec = campaign::ParseSpecText(journal.Campaign().spec_json)};
}

// One class of equal grains, else five of equal volume at the middle of each.
std::vector<CardSize> SizesOf(const rigs::Case& rig_case) {
  constexpr int kClasses = 5;
  const engine::SizeCurve curve(rig_case.powder.sizes);
  const double f = rig_case.coarse_graining.scale_factor;
  if (!(curve.largest() > 1.0001 * curve.smallest())) {
    return {{.diameter = f * curve.VolumeQuantile(0.5), .volume_share = 1}};
  }
  std::vector<CardSize> sizes;
  for (int i = 0; i < kClasses; ++i) {
    sizes.push_back({.diameter = f * curve.VolumeQuantile((i + 0.5) / kClasses),
                     .volume_share = 1.0 / kClasses});
  }
  return sizes;
}

// What two grains state themselves.
std::vector<engine::MaterialPair> GrainPairs(const rigs::Case& rig_case) {
  const engine::PairProperties stated =
      engine::StatedOf(rigs::PairsOf(rig_case), rigs::kPowder, rigs::kPowder);
  if (!stated.Any()) return {};
  return {{.first = 0, .second = 0, .stated = stated}};
}

// What the grains are, without a test.
Card PowderCard(const rigs::Case& rig_case) {
  const rigs::PowderSize size = rigs::EstimatePowder(rig_case);
  return {.title = "one case",
          .materials = {{.name = "powder", .material = rigs::UsedMaterial(rig_case)}},
          .pairs = GrainPairs(rig_case),
          .models = rig_case.models,
          .scale_factor = rig_case.coarse_graining.scale_factor,
          .surface_energy_given = rig_case.powder.material.surface_energy,
          .mean_diameter = size.mean_diameter,
          .time_step = size.time_step,
          .gravity = rig_case.gravity,
          .sizes = SizesOf(rig_case)};
}

std::vector<std::string> CalibratedNames(const campaign::CampaignSpec& spec) {
  std::vector<std::string> names;
  for (const optimizer::Parameter& p : campaign::SpaceOf(spec).parameters) {
    if (!p.fixed) names.push_back(p.name);
  }
  return names;
}

// A set (all of the space's parameters, in its order) with the campaign's conditions and alarms.
Card CardWith(const Finished& finished, const std::vector<double>& values,
              const std::filesystem::path& folder) {
  const auto& [result, spec] = finished;
  Card card;
  const std::vector<campaign::ExperimentSpec> experiments = campaign::ExperimentsOf(spec);
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    const campaign::ExperimentSpec& experiment = experiments[i];
    if (experiment.name == spec.hold_out) continue;  // the set does not come from it
    const rigs::Case rig_case = campaign::CaseOf(spec,
                                                 {.values = values,
                                                  .scale_factor = result.conditions.scale_factor,
                                                  .experiment = static_cast<int>(i)},
                                                 std::nullopt);
    if (card.tests.empty()) {
      card = PowderCard(rig_case);
      if (spec.engine.kind == campaign::EngineKind::kCommand) {
        card.deck = DeckOf(spec.engine.command, rig_case, CalibratedNames(spec));
      }
    }
    AddTest(rig_case, experiment.name, card);
    if (experiment.rig) card.tests.back().rig = *experiment.rig;  // a drum with its fill
    card.tests.back().rig.lifted_tube = *experiment.device;
  }
  NameWalls(card);
  card.title = result.name;
  for (const campaign::Alarm& warning : result.warnings) {
    card.notes.push_back(campaign::WithFolder(campaign::AlarmText(warning), folder));
  }
  return card;
}

// The recommended set, where some parameters may be held.
std::vector<double> RecommendedValues(const Finished& finished) {
  const optimizer::ParameterSpace space = campaign::SpaceOf(finished.spec);
  std::vector<double> values;
  auto next = finished.result.parameters.begin();
  for (const optimizer::Parameter& p : space.parameters) {
    values.push_back(p.fixed ? *p.fixed : (next++)->value);
  }
  return values;
}

Card ReadCampaignCard(const std::filesystem::path& folder) {
  const Finished finished = ReadFinished(folder);
  const campaign::Answer& result = finished.result;
  Card card = CardWith(finished, RecommendedValues(finished), folder);
  for (const campaign::ResultParameter& p : result.parameters) {
    if (p.nuisance) {
      card.notes.push_back("not asked for, " + campaign::NuisanceText(p, p.name) +
                           "; the card has " + base::ShortNumber(p.value));
      continue;
    }
    card.ranges.push_back({.name = p.name,
                           .unit = p.unit,
                           .value = p.value,
                           .low = p.credible_low,
                           .high = p.credible_high,
                           .prior = p.prior ? p.prior->text : ""});
  }
  return card;
}

}  // namespace

Card CardOf(const rigs::Case& rig_case) {
  Card card = PowderCard(rig_case);
  AddTest(rig_case, std::string(base::NameOf(rig_case.rig.kind)), card);
  return card;
}

engine::Material ActingOn(const Card& card, std::size_t material, std::size_t other) {
  return engine::With(
      card.materials[material].material,
      engine::StatedOf(card.pairs, static_cast<int>(material), static_cast<int>(other)));
}

Card ReadCard(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) return ReadCampaignCard(path);
  const rigs::Case rig_case = trials::LoadAnyCase(path);
  Card card = CardOf(rig_case);
  if (const auto engine = trials::EngineOfCase(path)) {
    card.deck = DeckOf(*engine, rig_case, PowderPlaceholders());
  }
  card.title = path.filename().string();
  card.is_calibrated = false;
  return card;
}

std::vector<DrawCard> ReadDrawCards(const std::filesystem::path& folder, int count) {
  const Finished finished = ReadFinished(folder);
  const campaign::JointView view = campaign::ReadJointView(folder);
  const WeightedDraws draws = PosteriorSets(view, count);
  std::vector<DrawCard> cards;
  for (std::size_t i = 0; i < draws.points.size(); ++i) {
    const Eigen::VectorXd point = optimizer::VectorOf(draws.points[i]);
    Card card = CardWith(finished, view.space.ToNative(point), folder);
    card.title += ", draw " + std::to_string(i + 1) + " of " + std::to_string(draws.points.size()) +
                  " of the posterior, weight " + base::ShortNumber(draws.weights[i]);
    const std::vector<double> values = campaign::FreeValues(view.space, point);
    for (std::size_t p = 0; p < values.size(); ++p) {
      const journal::ParameterRecord& parameter = view.record.parameters[p];
      card.ranges.push_back({.name = parameter.name, .unit = parameter.unit, .value = values[p]});
    }
    cards.push_back({.card = std::move(card), .weight = draws.weights[i]});
  }
  return cards;
}

// F = k_n δ with k_n = (4/3) Y* √(R* δ)  ⇒  δ = (F / ((4/3) Y* √R*))^(2/3).
TypicalContact TypicalContactOf(const Card& card, const engine::PairConstants& pair,
                                Against against) {
  constexpr double kGrainWeights = 10;
  const double radius = card.mean_diameter / 2;
  const double mass = engine::SphereMass(ActingOn(card, 0, 0), radius);
  const double share = against == Against::kGrain ? 0.5 : 1;
  TypicalContact contact{
      .pair = pair, .grain_radius = radius, .r_star = share * radius, .m_star = share * mass};
  const double force = kGrainWeights * mass * card.gravity;
  const double hertz = contact.pair.normal_stiffness * std::sqrt(contact.r_star);
  const double overlap = std::pow(force / hertz, 2.0 / 3);
  contact.radius = std::sqrt(contact.r_star * overlap);
  contact.normal_stiffness = contact.pair.normal_stiffness * contact.radius;
  return contact;
}

TypicalContact TypicalContactOf(const Card& card) {
  const engine::Material powder = ActingOn(card, 0, 0);
  return TypicalContactOf(card, engine::MakePairConstants(powder, powder, card.models),
                          Against::kGrain);
}

// C_r = 2 η_r √(I* k_r), where I* = 1.4 m* R² of two equal grains and of one at a wall.
double RollingDissipation(const TypicalContact& typical, double stiffness, double damping) {
  const double inertia = 1.4 * typical.m_star * typical.grain_radius * typical.grain_radius;
  return 2 * damping * std::sqrt(inertia * stiffness) / typical.r_star;
}

std::string CardText(const Card& card, CardFormat format) {
  if (card.deck) return DeckCardText(card, format);
  switch (format) {
    case CardFormat::kTable:
      return TableCard(card);
    case CardFormat::kJson:
      return JsonCard(card);
    case CardFormat::kLethe:
      return LetheCard(card);
    case CardFormat::kLiggghts:
      return LiggghtsCard(card);
    case CardFormat::kLammps:
      return LammpsCard(card);
    case CardFormat::kYade:
      return YadeCard(card);
    case CardFormat::kMercuryDpm:
      return MercuryDpmCard(card);
  }
  return {};
}

}  // namespace talus::analysis
