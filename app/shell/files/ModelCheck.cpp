// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/files/ModelCheck.h"

#include "app/document/JobRunner.h"
#include "app/document/LiveCity.h"
#include "app/document/ProjectDocument.h"
#include "app/pipeline/LoadedCity.h"
#include "app/shell/Notices.h"
#include "widgets/inspector/Inspector.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QMainWindow>
#include <memory>
#include <utility>

namespace reflet {
namespace {

/// What can be told of how a file is read, by SourceSummary::format.
ModelFacts::Kind kindOf(const ModelReference& model, const std::string& format) {
    using Kind = ModelFacts::Kind;
    if (model.use != ModelUse::City || format == "3D Tiles") {
        return Kind::Other;
    }
    if (format == "CityJSON" || format == "CityJSONSeq" || format == "CityGML") {
        return Kind::Objects;
    }
    if (format == "OBJ" || format == "glTF") {
        return Kind::Mesh;
    }
    return format == "OpenStreetMap" ? Kind::StreetMap : Kind::Outlines;
}

}  // namespace

ModelCheck::ModelCheck(Workbench& bench, QObject* parent) : QObject(parent), m_bench(bench) {
    connect(bench.document, &ProjectDocument::projectChanged, this, [this](ProjectChanges what) {
        if (what & ProjectChange::Models) {
            check();
        }
    });
    connect(bench.document, &ProjectDocument::fileChanged, this, [this] { m_told.clear(); });
    connect(bench.live, &LiveCity::cityChanged, this, &ModelCheck::showFacts);
    connect(bench.inspector, &Inspector::readingChanged, this, &ModelCheck::readOtherwise);
    connect(bench.inspector, &Inspector::locateFileRequested, this,
            [this](const QString& path) { locate(path.toStdString()); });
}

void ModelCheck::check() {
    m_bench.jobs->run<Findings>(
        {.title = tr("Looking at the city's files"),
         .lane = QStringLiteral("modelCheck"),
         .visible = false},
        [models = m_bench.document->project().models,
         folder = m_bench.document->folder()](const JobContext& job) -> Result<Findings> {
            Findings findings;
            for (const ModelReference& model : models) {
                if (job.cancelled()) {
                    return tl::unexpected(JobContext::cancelledError());
                }
                Finding& finding = findings[model.path];
                const auto hash = fileHash(modelPath(model, folder));
                if (!hash) {
                    finding.mark = FileMark::Missing;
                } else if (!model.hash.empty() && model.hash != *hash) {
                    finding = {FileMark::Changed, *hash};
                }
            }
            return findings;
        },
        this,
        [this](const Result<Findings>& findings) {
            if (findings) {
                show(*findings);
            }
        });
}

void ModelCheck::show(const Findings& findings) {
    std::map<std::string, FileMark> marks;
    for (const auto& [path, finding] : findings) {
        marks[path] = finding.mark;
        if (finding.mark == FileMark::Fine || !m_told.insert(path).second) {
            continue;
        }
        const QString name = QFileInfo(QString::fromStdString(path)).fileName();
        const Notices::Action find{tr("Locate…"), [this, path = path] { locate(path); }};
        if (finding.mark == FileMark::Missing) {
            m_bench.notices->tell(Severity::Error,
                                  tr("The city file “%1” is not where the project says.").arg(name),
                                  {find}, tr("Looked for: %1").arg(QString::fromStdString(path)));
        } else {
            m_bench.notices->tell(
                Severity::Warning,
                tr("The city file “%1” has changed since it was added.").arg(name),
                {{tr("Use it as it is"),
                  [this, path = path, hash = finding.hash] { useAsItIs(path, hash); }},
                 find},
                tr("Probes that show what has changed take their pictures anew."));
        }
    }
    m_marks = marks;
    m_bench.tree->setModelMarks(std::move(marks));
    showFacts();
}

void ModelCheck::showFacts() {
    std::map<std::string, ModelFacts> facts;
    const std::vector<FileReport> reports = m_bench.live->reports();
    for (const ModelReference& model : m_bench.document->project().models) {
        ModelFacts& fact = facts[model.path];
        const auto mark = m_marks.find(model.path);
        fact.missing = mark != m_marks.end() && mark->second == FileMark::Missing;
        fact.changed = mark != m_marks.end() && mark->second == FileMark::Changed;
        const std::string file = modelPath(model, m_bench.document->folder()).string();
        for (const FileReport& report : reports) {
            if (report.file != file) {
                continue;
            }
            const SourceSummary& summary = report.summary;
            fact.format = QString::fromStdString(summary.format + ' ' + summary.version);
            fact.crs = QString::fromStdString(summary.crsHorizontal.value_or(""));
            fact.kind = kindOf(model, summary.format);
            for (const std::string& lod : summary.lods) {
                fact.lods << QString::fromStdString(lod);
            }
            fact.objects = qsizetype(summary.objects);
            fact.triangles = qsizetype(summary.triangles + summary.instanceTriangles);
        }
    }
    m_bench.inspector->setModelFacts(std::move(facts));
}

/// The project follows once the file has been read that way: an attribute that it does not have
/// shall not take the city away.
void ModelCheck::readOtherwise(const ModelReference& as) {
    Project project = m_bench.document->project();
    for (ModelReference& model : project.models) {
        if (model.path == as.path) {
            model = as;
        }
    }
    using City = std::shared_ptr<const LoadedCity>;
    m_bench.jobs->run<City>(
        {.title = tr("Reading the model otherwise"), .lane = QStringLiteral("readOtherwise")},
        [project, folder = m_bench.document->folder()](const JobContext& job) -> Result<City> {
            auto city = loadCity(project, folder, job);
            if (!city) {
                return tl::unexpected(city.error());
            }
            return std::make_shared<const LoadedCity>(*std::move(city));
        },
        this,
        [this, project, as, before = m_bench.document->project().models](const Result<City>& city) {
            const Project& now = m_bench.document->project();
            if (city && now.models == before) {
                Project after = now;
                after.models = project.models;
                m_bench.live->setReadCity(after, *city);
                m_bench.document->replaceProject(std::move(after), tr("Read the model otherwise"));
                return;
            }
            if (!city && city.error().code != ErrorCode::Cancelled) {
                m_bench.notices->tell(city.error());
            }
            showFacts();  // and what the model was read with
        });
}

void ModelCheck::locate(const std::string& path) {
    auto* dialog = new QFileDialog(
        m_bench.window, tr("Where is %1?").arg(QFileInfo(QString::fromStdString(path)).fileName()));
    dialog->setObjectName(QStringLiteral("locateDialog"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::ExistingFile);
    connect(dialog, &QFileDialog::fileSelected, this,
            [this, path](const QString& file) { replace(path, file); });
    dialog->open();
}

void ModelCheck::useAsItIs(const std::string& path, const std::string& hash) {
    Project project = m_bench.document->project();
    for (ModelReference& model : project.models) {
        if (model.path == path) {
            model.hash = hash;
        }
    }
    m_bench.document->replaceProject(std::move(project), tr("Use the changed city file"));
    m_bench.live->reload();
}

void ModelCheck::replace(const std::string& path, const QString& file) {
    const std::filesystem::path found = file.toStdString();
    const auto hash = fileHash(found);
    if (!hash) {
        m_bench.notices->tell(hash.error());
        return;
    }
    Project project = m_bench.document->project();
    const std::filesystem::path folder = m_bench.document->folder();
    for (ModelReference& model : project.models) {
        if (model.path == path) {
            const auto relative =
                folder.empty() ? std::filesystem::path() : found.lexically_relative(folder);
            model.path = (relative.empty() ? found : relative).generic_string();
            model.hash = *hash;
        }
    }
    m_bench.document->replaceProject(std::move(project), tr("Locate a city file"));
}

}  // namespace reflet
