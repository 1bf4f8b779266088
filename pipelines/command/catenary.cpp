#include "pipelines/command/catenary.h"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <stdexcept>

#include "nurbs/curve_through.h"
#include "nurbs/number_text.h"

namespace nurbeam {

namespace {

std::string text_of_number(double value) { return text_of(value, 12); }

std::string text_of_point(const Eigen::Vector3d& p) {
  return "[" + text_of_number(p.x()) + ", " + text_of_number(p.y()) + ", " + text_of_number(p.z()) + "]";
}

// The items of an array, one a line.
class Lines {
 public:
  Lines(std::ostream& out, const std::string& key) : out_(out) { out_ << "  \"" << key << "\": ["; }
  void add(const std::string& item) {
    out_ << (first_ ? "\n    " : ",\n    ") << item;
    first_ = false;
  }
  ~Lines() { out_ << "\n  ],\n"; }
  Lines(const Lines&) = delete;
  Lines& operator=(const Lines&) = delete;

 private:
  std::ostream& out_;
  bool first_ = true;
};

bool is_straight(const CatenaryData& data) { return data.pre_sag == 0 && data.stagger == 0; }

// Where a wire is held, as a place of its beam.
std::string place(const Eigen::Vector3d& point, bool straight) {
  if (straight) return "{ \"length\": " + text_of_number(point.x()) + " }";
  return "{ \"near\": " + text_of_point(point) + ", \"within\": 0.1 }";
}

std::vector<double> masts_and_droppers(const CatenaryData& data) {
  std::vector<double> places = data.masts();
  for (std::size_t i = 0; i < data.spans.size(); ++i)
    for (const double x : data.droppers_of(i)) places.push_back(x);
  std::ranges::sort(places);
  return places;
}

std::vector<Eigen::Vector3d> drawn_contact(const CatenaryData& data) {
  const std::vector<double> places =
      is_straight(data) ? std::vector<double>{0, data.length()} : masts_and_droppers(data);
  std::vector<Eigen::Vector3d> points;
  for (const double x : places) points.push_back(data.contact_at(x));
  return points;
}

std::vector<Eigen::Vector3d> drawn_messenger(const CatenaryData& data) {
  std::vector<Eigen::Vector3d> points;
  for (const double x : masts_and_droppers(data)) points.push_back(data.messenger_at(x));
  return points;
}

std::string axis(const std::vector<Eigen::Vector3d>& points) {
  constexpr int a_line = 5;
  std::string text = points.size() > 2 ? "{ \"through\": [" : "{ \"polyline\": [";
  for (std::size_t i = 0; i < points.size(); ++i)
    text += (i == 0 ? "" : i % a_line == 0 ? ",\n        " : ", ") + text_of_point(points[i]);
  return text + "] }";
}

std::string beam(const CatenaryData& data, const char* name, const CatenaryWire& wire,
                 const std::vector<Eigen::Vector3d>& points) {
  return std::string("{ \"name\": \"") + name + "\", \"axis\": " + axis(points) +
         ",\n      \"stress_free\": \"straight\", \"tension\": " + text_of_number(wire.tension) +
         ",\n      \"section\": { \"area\": " + text_of_number(wire.area) +
         ", \"second_moment\": " + text_of_number(wire.second_moment) +
         " },\n      \"material\": { \"density\": " + text_of_number(wire.density) +
         ", \"youngs_modulus\": " + text_of_number(wire.modulus) +
         ", \"mass_damping\": " + text_of_number(data.mass_damping) +
         ", \"stiffness_damping\": " + text_of_number(data.stiffness_damping) +
         " },\n      \"elements\": { \"max_length\": " + text_of_number(data.element) + " } }";
}

void write_beams(const CatenaryData& data, std::ostream& out) {
  Lines lines(out, "beams");
  lines.add(beam(data, "messenger", data.messenger, drawn_messenger(data)));
  lines.add(beam(data, "contact wire", data.contact, drawn_contact(data)));
}

// Both wires end at a weight that keeps their tension; masts hold the messenger across its line.
void write_supports(const CatenaryData& data, std::ostream& out) {
  Lines lines(out, "supports");
  for (const auto& [beam, tension] : {std::pair<std::string, double>{"messenger", data.messenger.tension},
                                      std::pair<std::string, double>{"contact wire", data.contact.tension}}) {
    const std::string begin = "{ \"beam\": \"" + beam + "\", \"at\": ";
    lines.add(begin + "\"start\", \"type\": \"pinned\", \"name\": \"" + beam + " anchor\" }");
    lines.add(begin + "\"end\", \"type\": \"guided\", \"direction\": [1, 0, 0], \"force\": " +
              text_of_number(tension) + ", \"name\": \"" + beam + " weight\" }");
  }
  const std::vector<double> masts = data.masts();
  for (std::size_t i = 1; i + 1 < masts.size(); ++i)
    lines.add("{ \"beam\": \"messenger\", \"at\": " + place(data.messenger_at(masts[i]), false) +
              ", \"type\": \"guided\", \"direction\": [1, 0, 0], \"name\": \"mast " + std::to_string(i + 1) +
              "\" }");
}

std::string end_of(const char* key, const char* beam, const Eigen::Vector3d& point, bool straight) {
  return std::string("\"") + key + "\": { \"beam\": \"" + beam + "\", \"at\": " + place(point, straight) +
         " }";
}

void add_arms(const CatenaryData& data, Lines& lines) {
  const std::vector<double> masts = data.masts();
  for (std::size_t i = 1; data.arm && i + 1 < masts.size(); ++i) {
    const Eigen::Vector3d wire = data.contact_at(masts[i]),
                          mast = wire + Eigen::Vector3d(0, std::copysign(*data.arm, wire.y()), 0);
    lines.add("{ \"name\": \"arm " + std::to_string(i + 1) + "\", \"type\": \"rod\", " +
              end_of("from", "contact wire", wire, is_straight(data)) +
              ", \"to\": { \"point\": " + text_of_point(mast) + " }" +
              (data.arm_mass > 0 ? ", \"end_masses\": [" + text_of_number(data.arm_mass) + ", 0]" : "") +
              " }");
  }
}

void write_connectors(const CatenaryData& data, std::ostream& out) {
  Lines lines(out, "connectors");
  const std::string masses = text_of_number(data.clamp_mass);
  for (std::size_t span = 0; span < data.spans.size(); ++span) {
    const std::vector<double> places = data.droppers_of(span);
    for (std::size_t i = 0; i < places.size(); ++i)
      lines.add("{ \"name\": \"dropper " + std::to_string(span + 1) + "." + std::to_string(i + 1) +
                "\", \"type\": \"tension-only\", \"stiffness\": " + text_of_number(data.dropper_stiffness) +
                ", \"length\": " +
                (data.dropper_lengths.empty() ? "\"as-drawn\"" : text_of_number(data.dropper_lengths[i])) +
                (data.clamp_mass > 0 ? ", \"end_masses\": [" + masses + ", " + masses + "]" : "") +
                ",\n      " + end_of("from", "contact wire", data.contact_at(places[i]), is_straight(data)) +
                ", " + end_of("to", "messenger", data.messenger_at(places[i]), false) + " }");
  }
  add_arms(data, lines);
}

// What registration bears of the contact wire.
void write_loads(const CatenaryData& data, std::ostream& out) {
  const std::vector<double> masts = data.masts();
  Lines lines(out, "loads");
  for (std::size_t i = 1; i + 1 < masts.size(); ++i)
    lines.add("{ \"beam\": \"contact wire\", \"at\": " + place(data.contact_at(masts[i]), is_straight(data)) +
              ", \"force\": " + text_of_point({0, 0, data.lift_at(i)}) + " }");
}

// Two spans in the middle, before which there are three at least where there are so many.
std::pair<double, double> evaluated(const CatenaryData& data) {
  const std::vector<double> masts = data.masts();
  const std::size_t middle = data.spans.size() / 2;
  return {masts[middle > 0 ? middle - 1 : 0], masts[std::min(middle + 1, data.spans.size())]};
}

std::string probe_at(double x) { return "contact wire at " + text_of_number(x) + " m"; }

// That of EN 50318:2002.
void write_pantograph(const CatenaryData& data, std::ostream& out) {
  const auto [from, to] = evaluated(data);
  const std::vector<double> masts = data.masts();
  std::string uplift;
  for (const double x : masts)
    if (x >= from && x <= to && x > 0 && x < data.length())
      uplift += (uplift.empty() ? "\"" : ", \"") + probe_at(x) + "\"";
  Lines lines(out, "collectors");
  lines.add("{ \"name\": \"pantograph\", \"beam\": \"contact wire\", \"at\": " +
            place(data.contact_at(masts[1] / 2), is_straight(data)) +
            ",\n      \"travel\": [1, 0, 0], \"up\": [0, 0, 1], \"motion\": { \"speed\": " +
            text_of_number(*data.speed) +
            " },\n      \"masses\": [15, 7.2], \"stiffness\": [50, 4200], \"damping\": [90, 10], "
            "\"contact\": { \"stiffness\": 50000 },\n      \"force\": 120, \"force_on\": 2, \"evaluate\": [" +
            text_of_number(from) + ", " + text_of_number(to) +
            "], \"bands\": [[0, 5], [5, 20]],\n      \"uplift\": [" + uplift + "] }");
}

void write_rest(const CatenaryData& data, std::ostream& out) {
  if (!data.speed) {
    out << "  \"analysis\": { \"type\": \"static\" }\n}\n";
    return;
  }
  const auto [from, to] = evaluated(data);
  const std::vector<double> masts = data.masts();
  // On into the span behind those that are evaluated.
  const auto behind = std::ranges::upper_bound(masts, to);
  const double last = behind == masts.end() ? to - 1 : (to + *behind) / 2;
  out << "  \"analysis\": { \"initial\": \"equilibrium\", \"end_time\": "
      << text_of_number((last - masts[1] / 2) / *data.speed) << ", \"step\": 0.001 },\n"
      << "  \"output\": { \"every\": 0.05, \"probes\": [";
  bool first = true;
  for (const double x : masts) {
    if (!(x >= from && x <= to && x > 0 && x < data.length())) continue;
    out << (first ? "\n    " : ",\n    ") << "{ \"name\": \"" << probe_at(x)
        << "\", \"beam\": \"contact wire\", \"at\": " << place(data.contact_at(x), is_straight(data)) << " }";
    first = false;
  }
  out << "\n  ] }\n}\n";
}

[[noreturn]] void refuse(const std::string& option, double value, const std::string& rule) {
  throw std::invalid_argument(option + ": is " + text_of(value) + "; " + rule);
}

}  // namespace

double CatenaryData::length() const { return masts().back(); }

std::vector<double> CatenaryData::masts() const {
  std::vector<double> places{0};
  for (const double span : spans) places.push_back(places.back() + span);
  return places;
}

std::vector<double> CatenaryData::droppers_of(std::size_t span) const {
  std::vector<double> places;
  const double start = masts()[span];
  for (const double x : droppers) places.push_back(start + x * spans[span] / spans[0]);
  return places;
}

double CatenaryData::lift_at(std::size_t mast) const {
  if (mast_force) return *mast_force;
  constexpr double gravity = 9.81;
  const double between = droppers_of(mast).front() - droppers_of(mast - 1).back();
  return between / 2 * contact.area * contact.density * gravity;
}

// A string that both wires load: its sag is the moment of the loads of a span over its tension.
Eigen::Vector3d CatenaryData::messenger_at(double x) const {
  constexpr double gravity = 9.81;
  const std::vector<double> places = masts();
  const auto span = static_cast<std::size_t>(std::upper_bound(places.begin() + 1, places.end() - 1, x) -
                                             places.begin() - 1);
  const double L = spans[span], at = x - places[span], own = messenger.area * messenger.density * gravity,
               hung = contact.area * contact.density * gravity;
  double moment = own * at * (L - at) / 2;
  const std::vector<double> here = droppers_of(span);
  for (std::size_t i = 0; i < here.size(); ++i) {
    const double before = i > 0      ? here[i - 1]
                          : span > 0 ? droppers_of(span - 1).back()
                                     : 0,
                 after = i + 1 < here.size()       ? here[i + 1]
                         : span + 1 < spans.size() ? droppers_of(span + 1).front()
                                                   : length(),
                 force = hung * (after - before) / 2, place = here[i] - places[span];
    moment += force * std::min(at * (L - place), place * (L - at)) / L;
  }
  return {x, 0, encumbrance - moment / messenger.tension};
}

Eigen::Vector3d CatenaryData::contact_at(double x) const {
  const std::vector<double> places = masts();
  const auto after = std::upper_bound(places.begin() + 1, places.end() - 1, x);
  const auto span = static_cast<std::size_t>(after - places.begin()) - 1;
  const double part = (x - places[span]) / spans[span], side = span % 2 == 0 ? 1 : -1;
  return {x, side * stagger * (1 - 2 * part), -4 * pre_sag * part * (1 - part)};
}

void check(const CatenaryData& data) {
  if (data.spans.empty())
    throw std::invalid_argument("--spans: has no span; give lengths, as 60,60 or 10x60");
  for (const double span : data.spans)
    if (!(span > 0)) refuse("--spans", span, "each must be above 0 m");
  for (std::size_t i = 0; i < data.droppers.size(); ++i) {
    const double x = data.droppers[i];
    if (!(x > 0 && x < data.spans[0]))
      refuse("--droppers", x,
             "must be inside the first span, between 0 and " + text_of(data.spans[0]) + " m");
    if (i > 0 && x <= data.droppers[i - 1]) refuse("--droppers", x, "places must increase");
  }
  if (data.droppers.size() < 2)
    throw std::invalid_argument("--droppers: has " + std::to_string(data.droppers.size()) +
                                " places; a contact wire hangs on two droppers a span at least");
  if (!data.dropper_lengths.empty() && data.dropper_lengths.size() != data.droppers.size())
    throw std::invalid_argument("--dropper-lengths: has " + std::to_string(data.dropper_lengths.size()) +
                                " lengths for " + std::to_string(data.droppers.size()) +
                                " \"--droppers\"; give one for each, or none");
  if (!(data.encumbrance > 0)) refuse("--encumbrance", data.encumbrance, "must be above 0 m");
  if (data.stagger != 0 && !data.arm)
    throw std::invalid_argument(
        "--stagger: needs registration arms, which hold the contact wire aside; give \"--arm\" their length");
  if (data.arm && !(*data.arm > 0)) refuse("--arm", *data.arm, "must be above 0 m");
  for (const auto& [option, value] :
       {std::pair{"--contact-tension", data.contact.tension},
        std::pair{"--messenger-tension", data.messenger.tension}, std::pair{"--element", data.element},
        std::pair{"--dropper-stiffness", data.dropper_stiffness}})
    if (!(value > 0)) refuse(option, value, "must be above 0");
  if (data.speed && data.spans.size() < 2) refuse("--pantograph", *data.speed, "needs two spans at least");
  if (data.speed && !(*data.speed > 0)) refuse("--pantograph", *data.speed, "must be above 0 m/s");
}

void write_case(const CatenaryData& data, const std::string& name, std::ostream& out) {
  out << "{\n  // Made by `nurbeam catenary`: " << data.spans.size() << " spans, "
      << text_of_number(data.length()) << " m, along x.\n  \"nurbeam\": 1,\n  \"name\": \"" << name
      << "\",\n";
  write_beams(data, out);
  write_supports(data, out);
  write_connectors(data, out);
  if (data.mast_force != 0) write_loads(data, out);
  if (data.speed) write_pantograph(data, out);
  write_rest(data, out);
}

std::vector<NamedCurve> wires_of(const CatenaryData& data) {
  const auto line = [](const std::vector<Eigen::Vector3d>& points) {
    return curve_through(points, {.degree = points.size() > 2 ? 3 : 1, .tangents = {}});
  };
  return {{"messenger", line(drawn_messenger(data))}, {"contact wire", line(drawn_contact(data))}};
}

}  // namespace nurbeam
