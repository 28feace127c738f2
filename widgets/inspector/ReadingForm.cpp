// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/inspector/ReadingForm.h"

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QStringList>
#include <algorithm>
#include <array>

namespace reflet {

namespace {

constexpr const char* kHighest = "highest";
constexpr std::array<const char*, 3> kUpAxes{"", "z", "y"};

/// The words of a text with commas between.
std::vector<std::string> wordsOf(const QString& text) {
    std::vector<std::string> words;
    for (const QString& part : text.split(QLatin1Char(','), Qt::SkipEmptyParts)) {
        if (const QString word = part.trimmed(); !word.isEmpty())
            words.push_back(word.toStdString());
    }
    return words;
}

}  // namespace

ReadingForm::ReadingForm(QWidget* parent) : FieldForm(parent) {
    m_heading = heading();
    m_heading->setText(tr("How it is read"));
    m_detail = choice(tr("&Detail"), tr("The level of detail (LoD) that is shown of each object"),
                      [this](int) {
                          m_model.lod = m_detail->currentData().toString().toStdString();
                          changed(m_model);
                      });
    m_detail->setObjectName(QStringLiteral("modelDetail"));
    m_types = text(tr("Only &types"),
                   tr("Kinds of objects to load, as the file names them, with commas between; "
                      "empty for all: Building, Bridge, Road"),
                   [this](const QString& types) {
                       m_model.types = wordsOf(types);
                       changed(m_model);
                   });
    m_types->setObjectName(QStringLiteral("modelTypes"));
    m_types->setPlaceholderText(tr("all"));
    m_height = attribute(tr("&Height from"),
                         tr("The attribute with the height above the ground, in metres; empty "
                            "leaves it to Reflet"),
                         "modelHeightField", &ModelReference::heightField);
    m_base = attribute(tr("&Ground from"),
                       tr("The attribute with the elevation of the ground at a building; empty "
                          "leaves it to Reflet"),
                       "modelBaseField", &ModelReference::baseField);
    m_crown = attribute(tr("C&rown from"),
                        tr("Of trees: the attribute with the diameter of the crown; empty leaves "
                           "it to Reflet"),
                        "modelCrownField", &ModelReference::crownField);
    m_defaultHeight = number(
        tr("H&eight else"), tr("The height of what does not tell one; 0 leaves it to Reflet"),
        {0.0, 1000.0, 1.0, 1, tr(" m")}, [this](double value, DragPhase phase) {
            m_model.defaultHeight = value > 0.0 ? std::optional(value) : std::nullopt;
            if (phase == DragPhase::End)
                changed(m_model);
        });
    m_defaultHeight->setObjectName(QStringLiteral("modelDefaultHeight"));
    m_defaultHeight->setSpecialValueText(tr("automatic"));
    m_up = choice(tr("U&p"), tr("The axis of the file that points up"), [this](int chosen) {
        m_model.upAxis = kUpAxes[std::size_t(chosen)];
        changed(m_model);
    });
    m_up->setObjectName(QStringLiteral("modelUp"));
    m_up->addItems({tr("as the file has it"), tr("z"), tr("y")});
    m_unit = number(tr("&Unit"), tr("How long one unit of the file is: 0.001 for millimetres"),
                    {1e-6, 1e6, 0.1, 6, tr(" m")}, [this](double value, DragPhase phase) {
                        m_model.unit = value == 1.0 ? std::nullopt : std::optional(value);
                        if (phase == DragPhase::End)
                            changed(m_model);
                    });
    m_unit->setObjectName(QStringLiteral("modelUnit"));
}

QLineEdit* ReadingForm::attribute(const QString& name, const QString& help, const char* objectName,
                                  std::string ModelReference::*member) {
    QLineEdit* edit = text(name, help, [this, member](const QString& value) {
        m_model.*member = value.trimmed().toStdString();
        changed(m_model);
    });
    edit->setObjectName(QLatin1String(objectName));
    edit->setPlaceholderText(tr("automatic"));
    return edit;
}

void ReadingForm::showDetail(const QStringList& lods) {
    QStringList all = lods;
    const QString chosen = QString::fromStdString(m_model.lod);
    if (m_model.lod != kHighest && !all.contains(chosen))
        all << chosen;
    m_detail->clear();
    m_detail->addItem(tr("the highest of each object"), QLatin1String(kHighest));
    for (const QString& lod : all)
        m_detail->addItem(tr("LoD %1").arg(lod), lod);
    m_detail->setCurrentIndex(std::max(0, m_detail->findData(chosen)));
    setShown(m_detail, all.size() > 1 || m_model.lod != kHighest);
}

void ReadingForm::show(const ModelReference& model, const ModelFacts& facts) {
    m_model = model;
    showDetail(facts.lods);
    QStringList types;
    for (const std::string& type : model.types)
        types << QString::fromStdString(type);
    showText(m_types, types.join(QStringLiteral(", ")));
    showText(m_height, QString::fromStdString(model.heightField));
    showText(m_base, QString::fromStdString(model.baseField));
    showText(m_crown, QString::fromStdString(model.crownField));
    m_defaultHeight->show(model.defaultHeight.value_or(0.0));
    const auto up = std::find(kUpAxes.begin(), kUpAxes.end(), model.upAxis);
    m_up->setCurrentIndex(up == kUpAxes.end() ? 0 : int(up - kUpAxes.begin()));
    m_unit->show(model.unit.value_or(1.0));

    using Kind = ModelFacts::Kind;
    const bool objects = facts.kind == Kind::Objects, mesh = facts.kind == Kind::Mesh;
    const bool outlines = facts.kind == Kind::Outlines;
    setShown(m_types, objects);
    for (QWidget* field : {m_height, m_base, m_crown})
        setShown(field, outlines);
    setShown(m_defaultHeight, outlines || facts.kind == Kind::StreetMap);
    setShown(m_up, mesh);
    setShown(m_unit, mesh);
    setVisible(facts.kind != Kind::Other);
}

}  // namespace reflet
