#include "wild/summary.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

namespace massprops::wild {
namespace {

using Trials = std::vector<std::pair<Case, Trial>>;

std::string fileOf(const std::string& path) {
  return path.substr(path.find_last_of('/') + 1);
}

const char* word(const Trial& trial) {
  switch (trial.outcome) {
  case Outcome::Hollow:
    return trial.isSolved ? "yes" : "no";
  case Outcome::NothingFits:
    return "none";
  case Outcome::Refused:
    return "refused";
  case Outcome::EnclosesNothing:
  case Outcome::Unreadable:
    return "-";
  case Outcome::Failed:
    break;
  }
  return "FAILED";
}

/// The first sentence without its numbers.
std::string withoutNumbers(const std::string& text) {
  std::string result;
  for (const char c : text.substr(0, text.find_first_of(":."))) {
    if (std::isdigit(static_cast<unsigned char>(c)) == 0) {
      result += c;
    } else if (result.empty() || result.back() != '#') {
      result += '#';
    }
  }
  return result;
}

double median(std::vector<double> values) {
  if (values.empty()) return NAN;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double largest(const std::vector<double>& values) {
  return values.empty() ? NAN : *std::max_element(values.begin(), values.end());
}

bool counts(const Trial& trial) {
  return trial.outcome != Outcome::EnclosesNothing && trial.outcome != Outcome::Unreadable;
}

/// Of the trials for which it is so.
template <class Is>
int count(const Trials& trials, const Is& is) {
  return static_cast<int>(std::count_if(trials.begin(), trials.end(), [&](const auto& entry) {
    return counts(entry.second) && is(entry.second);
  }));
}

void printRow(const std::string& title, const Trials& trials) {
  const auto with = [&](Outcome outcome) {
    return count(trials, [&](const Trial& t) { return t.outcome == outcome; });
  };
  std::vector<double> gaps, walls, cpu, memory;
  for (const auto& [c, trial] : trials) {
    if (!counts(trial)) continue;
    cpu.push_back(trial.cpu);
    memory.push_back(trial.megabytes);
    if (trial.outcome != Outcome::Hollow) continue;
    walls.push_back(-trial.wall);
    if (!trial.isSmall && std::isfinite(trial.gap)) gaps.push_back(100.0 * trial.gap);
  }
  const int all = count(trials, [](const Trial&) { return true; });
  const int served = count(trials, isServed);
  std::printf("| %s | %d | %d (%.1f %%) | %d | %d | %d | %d | %d | %d | %d | %.2f, %.2f | %.4f | "
              "%.2f, %.1f | %.0f, %.0f |\n",
              title.c_str(), all, served, 100.0 * served / std::max(all, 1), with(Outcome::Hollow),
              with(Outcome::NothingFits), count(trials, isContradicted), with(Outcome::Refused),
              with(Outcome::Failed), count(trials, [](const Trial& t) { return t.isBroken; }),
              count(trials, [](const Trial& t) { return t.isWrapped; }), median(gaps),
              largest(gaps), -largest(walls), median(cpu), largest(cpu), median(memory),
              largest(memory));
}

/// Processor time of the best possible cavity over that of the offset surface, model by model.
void printRatios(const std::string& title, const Trials& offset, const Trials& best) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < std::min(offset.size(), best.size()); ++i) {
    const auto isDone = [](const Trial& t) {
      return t.outcome == Outcome::Hollow || t.outcome == Outcome::NothingFits;
    };
    if (isDone(offset[i].second) && isDone(best[i].second))
      ratios.push_back(best[i].second.cpu / offset[i].second.cpu);
  }
  if (ratios.empty()) return;
  std::printf("\n%s: Best possible over Offset surface, processor time, %zu models: median %.2f, "
              "largest %.2f, above 2: %ld\n",
              title.c_str(), ratios.size(), median(ratios), largest(ratios),
              static_cast<long>(
                  std::count_if(ratios.begin(), ratios.end(), [](double r) { return r > 2.0; })));
}

} // namespace

void printHead() {
  std::printf("%-36s %7s %-16s %4s %s %-7s %9s %9s %9s %8s %8s %7s %6s %6s %6s %6s %6s %6s %5s\n",
              "model", "faces", "goal", "wall", "s", "done", "before", "after", "limit", "gap",
              "violat.", "inner", "wall", "volume", "moved", "CPU s", "s", "check", "MB");
}

void print(const Case& c, const Trial& t) {
  const std::string file = fileOf(c.path); // the name is at its end
  constexpr std::size_t kWide = 36;
  const std::string name = file.size() > kWide ? file.substr(file.size() - kWide) : file;
  std::printf("%-36s %7ld %-16s %4.3g %d %-7s ", name.c_str(), t.faces, c.asked->name,
              100.0 * c.wallShare, static_cast<int>(c.shape), word(t));
  if (t.outcome == Outcome::Hollow || t.outcome == Outcome::NothingFits) {
    std::printf("%9.3f %9.3f %9.3f %7.2f%%%s %8.1e %7ld %6.3f %6.3f %6.2f %6.1f %6.1f %6.2f %5.0f",
                t.before, t.after, t.limit, 100.0 * t.gap, t.isSmall ? "*" : " ", t.violation,
                t.innerFaces, t.wall, t.volume, t.moved, t.cpu, t.seconds, t.checkSeconds,
                t.megabytes);
  } else {
    std::printf("%.1f s, %.0f MB", t.cpu, t.megabytes);
  }
  if (t.isTurned) std::printf("; +Y");
  if (t.isShell) std::printf("; shell");
  if (t.outcome == Outcome::NothingFits)
    std::printf("; %s: %.2f walls deep", isContradicted(t) ? "CONTRADICTED" : "confirmed",
                t.deepest);
  if (std::isfinite(t.gain)) std::printf(", %.3f degrees to gain", t.gain);
  if (t.outcome == Outcome::EnclosesNothing) std::printf("; encloses nothing");
  if (t.reason[0] != '\0') std::printf("; %s%s", t.isBroken ? "BROKEN: " : "", t.reason);
  const bool isMended = t.repairs[0] != '\0' && std::string(t.repairs) != "none";
  if (isMended) std::printf("; %s", t.repairs);
  if (!t.isJudged && t.outcome != Outcome::Failed && counts(t)) std::printf("; NOT JUDGED");
  std::printf("\n");
  std::fflush(stdout);
}

void printSummary(const Trials& trials) {
  std::map<std::string, Trials> byTitle;
  std::map<std::string, std::map<std::string, int>> reasons;
  for (const auto& [c, trial] : trials) {
    char title[80];
    std::snprintf(title, sizeof title, "%s, wall %.3g %%, shape %d", c.asked->name,
                  100.0 * c.wallShare, static_cast<int>(c.shape));
    byTitle[title].emplace_back(c, trial);
    if (trial.isWrapped) byTitle[std::string(title) + ", the wrapped"].emplace_back(c, trial);
    const bool isGone = trial.outcome == Outcome::Refused || trial.outcome == Outcome::Failed;
    if (isGone) ++reasons[title][withoutNumbers(trial.reason)];
  }
  std::printf("\n| | models | served | hollow | nothing fits | contradicted | refused | failed | "
              "broken | wrapped | gap, %% | least wall | CPU, s | MB |\n"
              "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& [title, of] : byTitle) printRow(title, of);
  for (const auto& [title, of] : byTitle) {
    const auto best = byTitle.find(title.substr(0, title.size() - 1) + '2');
    if (title.back() == '1' && best != byTitle.end()) printRatios(title, of, best->second);
  }
  for (const auto& [title, of] : reasons) {
    std::printf("\n%s, refused or failed:\n\n", title.c_str());
    for (const auto& [reason, n] : of) std::printf("- %d: %s\n", n, reason.c_str());
  }
}

} // namespace massprops::wild
