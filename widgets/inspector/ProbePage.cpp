// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/Look.h"
#include "widgets/inspector/InspectorPages.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <algorithm>

namespace reflet {

namespace {

constexpr int kLeastResolution = 32;
constexpr int kMostResolution = 1024;

template <class Get>
bool agree(const std::vector<Probe>& probes, const Get& get) {
    return std::all_of(probes.begin(), probes.end(),
                       [&](const Probe& probe) { return get(probe) == get(probes.front()); });
}

}  // namespace

ProbePage::ProbePage(QWidget* parent) : FieldForm(parent) {
    m_heading = heading();
    m_name = text(tr("&Name"), tr("The probe's name; it is written in exports and reports"),
                  [this](const QString& name) {
                      renamed({ProjectItem::Kind::Probe, m_probes.front().id}, name);
                  });
    const std::array<QString, 3> names{tr("&East"), tr("N&orth"), tr("&Up")};
    const std::array<QString, 3> helps{
        tr("Coordinate towards grid east, in the project's coordinate system"),
        tr("Coordinate towards grid north, in the project's coordinate system"),
        tr("Height in the project's height system")};
    for (int axis = 0; axis < 3; ++axis) {
        const NumberField field{-1e8, 1e8, axis == 2 ? 0.1 : 0.5, 2, tr(" m")};
        m_coordinates[axis] = number(names[std::size_t(axis)], helps[std::size_t(axis)], field,
                                     [this, axis](double value, DragPhase phase) {
                                         // Several move together: each by what the first one moves.
                                         const double by = value - m_probes.front().position[axis];
                                         const bool several = m_probes.size() > 1;
                                         change(phase, [=](Probe& probe, const Probe&) {
                                             probe.position[axis] =
                                                 several ? probe.position[axis] + by : value;
                                         });
                                     });
        m_coordinates[axis]->setObjectName(QStringLiteral("probe%1").arg("ENU"[axis]));
    }
    m_crs = fact(tr("System"), tr("The project's coordinate system"));
    m_height = number(tr("&Above ground"),
                      tr("Height of the probe's eye over the ground below it; probes see best "
                         "from the height of a vehicle's middle"),
                      {-100.0, 1000.0, 0.1, 2, tr(" m")}, [this](double value, DragPhase phase) {
                          std::size_t i = 0;
                          change(phase, [&](Probe& probe, const Probe&) {
                              if (m_ground[i])
                                  probe.position.z = *m_ground[i] + value;
                              ++i;
                          });
                      });
    m_height->setObjectName(QStringLiteral("probeHeight"));
    m_resolution = choice(
        tr("&Resolution"),
        tr("Picture points along an edge of each of the probe's six pictures; automatic takes "
           "the project's"),
        [this](int index) {
            change(DragPhase::End, [&](Probe& probe, const Probe&) {
                probe.resolution =
                    index == 0 ? std::nullopt : std::optional(m_sizes[std::size_t(index) - 1]);
            });
        });
    m_resolution->setObjectName(QStringLiteral("probeResolution"));
    for (int size = kLeastResolution; size <= kMostResolution; size *= 2)
        m_sizes.push_back(size);
    m_locked = check(
        tr("&Locked"), tr("Reflet never moves or removes this probe by itself"), [this](bool on) {
            change(DragPhase::End, [on](Probe& probe, const Probe&) { probe.locked = on; });
        });
    m_locked->setObjectName(QStringLiteral("probeLocked"));
    m_state = fact(tr("State"));
    m_preview = check(tr("Show as a &mirror ball"),
                      tr("A ball in the 3D view that reflects what the probe sees"),
                      [this](bool on) { preview(ids(), on); });
    m_preview->setObjectName(QStringLiteral("probePreview"));
    m_bake = new QPushButton(tr("&Bake now"), this);
    m_bake->setObjectName(QStringLiteral("probeBake"));
    m_bake->setToolTip(tr("Make the probe's pictures anew, in the background"));
    connect(m_bake, &QPushButton::clicked, this, [this] { bake(ids()); });
    row(m_bake);
}

void ProbePage::change(DragPhase phase,
                       const std::function<void(Probe&, const Probe& first)>& edit) {
    const Probe first = m_probes.front();
    for (Probe& probe : m_probes)
        edit(probe, first);
    changed(m_probes, phase);
}

std::vector<std::string> ProbePage::ids() const {
    std::vector<std::string> result;
    for (const Probe& probe : m_probes)
        result.push_back(probe.id);
    return result;
}

void ProbePage::show(const Project& project, const QString& crsName, std::vector<Probe> probes,
                     const std::map<std::string, ProbeFacts>& facts) {
    m_probes = std::move(probes);
    const bool one = m_probes.size() == 1;
    const Probe& first = m_probes.front();
    m_heading->setText(one ? tr("Reflection probe")
                           : tr("%n reflection probes", nullptr, int(m_probes.size())));
    setShown(m_name, one);
    showText(m_name, QString::fromStdString(first.id));
    for (int axis = 0; axis < 3; ++axis) {
        if (agree(m_probes, [axis](const Probe& probe) { return probe.position[axis]; }))
            m_coordinates[axis]->show(first.position[axis]);
        else
            m_coordinates[axis]->showSeveral(first.position[axis]);
    }
    m_crs->setText(crsName.isEmpty() ? tr("local metres") : crsName);

    m_resolution->clear();
    m_resolution->addItem(tr("Automatic (%1)").arg(project.bake.resolution));
    for (const int size : m_sizes)
        m_resolution->addItem(QString::number(size));
    const auto resolutionOf = [](const Probe& probe) { return probe.resolution.value_or(0); };
    if (!agree(m_probes, resolutionOf)) {
        m_resolution->setCurrentIndex(-1);
    } else if (const int own = resolutionOf(first); own == 0) {
        m_resolution->setCurrentIndex(0);
    } else {
        auto found = std::find(m_sizes.begin(), m_sizes.end(), own);
        if (found == m_sizes.end()) {  // a size of the project file that is no power of two
            found = m_sizes.insert(m_sizes.end(), own);
            m_resolution->addItem(QString::number(own));
        }
        m_resolution->setCurrentIndex(1 + int(found - m_sizes.begin()));
    }
    m_locked->setTristate(false);
    if (agree(m_probes, [](const Probe& probe) { return probe.locked; }))
        m_locked->setChecked(first.locked);
    else
        m_locked->setCheckState(Qt::PartiallyChecked);
    showHeights(facts);
    showState(facts);
}

void ProbePage::showHeights(const std::map<std::string, ProbeFacts>& facts) {
    m_ground.clear();
    std::vector<double> heights;
    for (const Probe& probe : m_probes) {
        const auto found = facts.find(probe.id);
        m_ground.push_back(found == facts.end() ? std::nullopt : found->second.groundHeight);
        if (m_ground.back())
            heights.push_back(probe.position.z - *m_ground.back());
    }
    m_height->setEnabled(heights.size() == m_probes.size());
    if (heights.size() != m_probes.size())
        m_height->setToolTip(tr("The ground below is not known"));
    constexpr double kSame = 0.005;  // metres: what the field shows
    const bool same = !heights.empty() &&
                      std::all_of(heights.begin(), heights.end(),
                                  [&](double h) { return std::abs(h - heights.front()) < kSame; });
    if (heights.empty() || same)
        m_height->show(heights.empty() ? 0.0 : heights.front());
    else
        m_height->showSeveral(heights.front());
}

void ProbePage::showState(const std::map<std::string, ProbeFacts>& facts) {
    std::map<ProbeState, int> counts;
    int previews = 0;
    ProbeFacts one;
    for (const Probe& probe : m_probes) {
        const auto found = facts.find(probe.id);
        one = found == facts.end() ? ProbeFacts{} : found->second;
        ++counts[one.state];
        previews += one.preview ? 1 : 0;
    }
    QStringList lines;
    for (const auto& [state, count] : counts)
        lines << (m_probes.size() == 1 ? probeStateText(state)
                                       : tr("%1 %2").arg(count).arg(probeStateText(state)));
    QString text = lines.join(QStringLiteral(", "));
    if (m_probes.size() == 1)
        text +=
            QLatin1Char('\n') + (one.problem.isEmpty() ? probeStateHelp(one.state) : one.problem);
    m_state->setText(text);
    m_bake->setEnabled(counts[ProbeState::Baking] < int(m_probes.size()));
    m_preview->setChecked(previews == int(m_probes.size()));
}

}  // namespace reflet
