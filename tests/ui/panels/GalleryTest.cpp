// SPDX-License-Identifier: GPL-3.0-or-later
// Every panel, filled, in light and dark and three sizes of text: nothing is cut off. With
// REFLET_GALLERY set to a folder, the pictures are kept there to be looked at.
#include "core/environment/CubeDirection.h"
#include "tests/ui/panels/PanelTestSupport.h"
#include "widgets/inspector/Inspector.h"
#include "widgets/panels/Checklist.h"
#include "widgets/panels/JobList.h"
#include "widgets/panels/MessageBar.h"
#include "widgets/panels/ProjectTree.h"
#include "widgets/panels/RemarkList.h"
#include "widgets/panels/ReportPanel.h"
#include "widgets/panels/SunPanel.h"
#include "widgets/panels/Timeline.h"
#include "widgets/plan/PlanView.h"
#include "widgets/preview/MapPreview.h"
#include "widgets/tuning/TuningPanel.h"
#include "widgets/vehicle/VehicleCard.h"

#include <QDir>
#include <QStyleFactory>
#include <QToolButton>
#include <QVBoxLayout>
#include <functional>
#include <memory>

namespace reflet {
namespace {

using Kind = ProjectItem::Kind;

struct Exhibit {
    const char* name;
    int width, height;
    std::function<std::unique_ptr<QWidget>()> make;
};

std::unique_ptr<QWidget> inspectorOf(const std::vector<ProjectItem>& items) {
    auto inspector = std::make_unique<Inspector>();
    inspector->setProject(test::streetProject(4), QStringLiteral("Amersfoort / RD New"));
    ProbeFacts facts;
    facts.groundHeight = 10.3;
    facts.state = ProbeState::Stale;
    inspector->setProbeFacts({{"rem-1", facts}, {"rem-2", facts}});
    inspector->setSelection(items);
    return inspector;
}

std::unique_ptr<QWidget> inspectorOfModel(ModelFacts::Kind kind) {
    auto inspector = std::make_unique<Inspector>();
    const Project project = test::streetProject(4);
    inspector->setProject(project, QStringLiteral("Amersfoort / RD New"));
    ModelFacts facts;
    facts.kind = kind;
    facts.format = QStringLiteral("CityJSON 2.0");
    facts.crs = QStringLiteral("EPSG:7415");
    facts.lods = {QStringLiteral("1.2"), QStringLiteral("1.3"), QStringLiteral("2.2")};
    facts.objects = 1252;
    facts.triangles = 77'764;
    const std::string path = project.models.front().path;
    inspector->setModelFacts({{path, facts}});
    inspector->setSelection({{Kind::Model, path}});
    return inspector;
}

std::unique_ptr<QWidget> tuning() {
    auto panel = std::make_unique<TuningPanel>();
    panel->setFigures(
        {{Method::Nearest, 17.3, 0.61, 0.4, 0, 0, std::nullopt, 0.213, 0.27},
         {Method::Blend, 18.9, 0.66, 0.7, 0, 0, std::nullopt, 0.188, 0.201},
         {Method::Mem, 27.8, 0.93, 4.2, 5312, 7120, 0.031, 0.058, 0.024},
         {Method::RayTrace, std::nullopt, std::nullopt, 92.0, 0, 98304, std::nullopt}},
        QStringLiteral("tram-1, 12.4 s"));
    FrameStatistics frame;
    frame.milliseconds = 31.0;
    frame.city = 14.0;
    frame.tracing = 4.0;
    frame.maps = 5.0;
    frame.inMaps = 2.0;
    frame.bodies = 4.0;
    frame.lod = {true, 2, 9.5, 3, 8, 2, 1, 2, 21};
    frame.overlays = 1.0;
    frame.localMaps = 5;
    frame.quads = 26'800;
    frame.rays = 31'200;
    frame.vertices = 20'000;
    frame.uncovered = 640;
    panel->setFrame(frame, 29.0);
    return panel;
}

std::unique_ptr<QWidget> expert() {
    auto panel = tuning();
    test::child<QToolButton>(*panel, "expertButton")->setChecked(true);
    return panel;
}

std::unique_ptr<QWidget> plan() {
    auto view = std::make_unique<PlanView>();
    const Project project = test::streetProject(11);
    view->setFrame(project.frame, QStringLiteral("Amersfoort / RD New"));
    view->setHeightfield(test::streetHeightfield());
    std::vector<ProbeGlyph> probes;
    for (int i = 0; i < 10; ++i)
        probes.push_back({"rem-" + std::to_string(i + 1),
                          {-90.0 + 20.0 * i, 0.0, 12.0},
                          ProbeState(i % 5),
                          i == 3,
                          false,
                          false});
    view->setProbes(std::move(probes));
    const std::vector<glm::dvec3> line{{-110.0, -3.0, 8.0}, {0.0, -3.0, 10.0}, {0.0, 70.0, 10.0}};
    view->setRoutes({{"route-1", line, line, true}});
    auto traffic = std::make_shared<Traffic>();
    traffic->add({"tram-1", "route-1",
                  std::make_shared<const Vehicle>(builtInVehicle("tram").value()),
                  std::make_shared<const Route>(Route(line).smoothed(20.0)), 8.0, 60.0});
    view->setTraffic(traffic);
    Camera camera;
    camera.position = {-60.0, 6.0, 11.0};
    camera.target = {-30.0, -3.0, 11.0};
    view->setCamera(camera);
    return view;
}

std::unique_ptr<QWidget> preview(MapQuantity quantity, MapProjection projection) {
    auto map = std::make_shared<ReferenceEnvironmentMap>();
    constexpr int kSize = 64;
    map->radiance = CubeMap<glm::vec3>(kSize);
    map->distance = CubeMap<float>(kSize);
    for (int face = 0; face < 6; ++face) {
        for (int row = 0; row < kSize; ++row) {
            for (int column = 0; column < kSize; ++column) {
                const auto d = glm::normalize(texelDirection(kSize, face, column, row));
                const bool house = std::abs(d.y) > 0.3 && d.z < 0.6 && d.z > -0.2;
                const bool sky = !house && d.z > 0.0;
                map->distance.at(face, column, row) =
                    sky ? kInfinity
                        : float(house ? 8.0 / std::abs(d.y) : 1.75 / std::max(0.02, -d.z));
                map->radiance.at(face, column, row) =
                    sky     ? glm::vec3(0.4F, 0.6F, 0.9F) * float(1.2 - 0.5 * d.z)
                    : house ? glm::vec3(0.5F, 0.35F, 0.25F) *
                                  (std::fmod(8.0 * d.x / d.y, 2.0) > 1.0 ? 1.0F : 0.4F)
                            : glm::vec3(0.2F);
            }
        }
    }
    auto widget = std::make_unique<MapPreview>();
    widget->setReference(map, QStringLiteral("Reflection probe rem-3"));
    widget->setQuantity(quantity);
    widget->setProjection(projection);
    return widget;
}

std::unique_ptr<QWidget> message() {
    auto window = std::make_unique<QWidget>();
    auto* bar = new MessageBar(window.get());
    auto* layout = new QVBoxLayout(window.get());
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(bar);
    layout->addStretch();
    Message post;
    post.severity = Severity::Warning;
    post.what = QStringLiteral("2 city models have changed since they were imported");
    post.subject = QStringLiteral("models/9-284-556.city.json, models/9-284-552.city.json");
    post.remedy = QStringLiteral("Import them again, or keep what was baked");
    post.details = QStringLiteral("while opening delft.reflet");
    post.actions = QStringList{QStringLiteral("Import again"), QStringLiteral("Keep")};
    bar->post(post);
    post.what = QStringLiteral("Another");
    bar->post(post);
    return window;
}

std::vector<Exhibit> exhibits() {
    return {
        {"plan", 720, 480, plan},
        {"inspector-probe", 320, 520,
         [] {
             return inspectorOf({{Kind::Probe, "rem-1"}});
         }},
        {"inspector-probes", 320, 520,
         [] {
             return inspectorOf({{Kind::Probe, "rem-1"}, {Kind::Probe, "rem-2"}});
         }},
        {"inspector-route", 320, 300,
         [] {
             return inspectorOf({{Kind::Route, "route-1"}});
         }},
        {"inspector-reflector", 320, 360,
         [] {
             return inspectorOf({{Kind::Reflector, "tram-1"}});
         }},
        {"inspector-vehicle", 320, 360,
         [] {
             return inspectorOf({{Kind::Vehicle, "delivery van"}});
         }},
        {"inspector-model", 320, 340, [] { return inspectorOfModel(ModelFacts::Kind::Objects); }},
        {"inspector-outlines", 320, 420,
         [] { return inspectorOfModel(ModelFacts::Kind::Outlines); }},
        {"inspector-view", 320, 300,
         [] {
             return inspectorOf({{Kind::View, "pavement"}});
         }},
        {"inspector-project", 320, 300, [] { return inspectorOf({}); }},
        {"tuning", 380, 640, tuning},
        {"tuning-expert", 380, 900, expert},
        {"tree", 280, 480,
         [] {
             auto tree = std::make_unique<ProjectTree>();
             tree->setProject(test::streetProject(7));
             tree->setProbeStates({{"rem-1", ProbeState::Fresh},
                                   {"rem-2", ProbeState::Stale},
                                   {"rem-3", ProbeState::Baking},
                                   {"rem-4", ProbeState::Refused}});
             tree->setModelMarks({{"models/street.city.json", FileMark::Changed}});
             return tree;
         }},
        {"map-colours", 560, 480,
         [] { return preview(MapQuantity::Radiance, MapProjection::Cross); }},
        {"map-distances", 560, 480,
         [] { return preview(MapQuantity::Distance, MapProjection::Cross); }},
        {"map-ball", 480, 480,
         [] { return preview(MapQuantity::Radiance, MapProjection::Sphere); }},
        {"sun", 380, 330,
         [] {
             auto sun = std::make_unique<SunPanel>();
             sun->setDate({});
             sun->setPlace(GeoPosition{0.0761, 0.9078, 0.0});
             return sun;
         }},
        {"checklist", 300, 330,
         [] {
             auto list = std::make_unique<Checklist>();
             list->setDone(Checklist::OpenCity, true);
             return list;
         }},
        {"jobs", 320, 240,
         [] {
             auto list = std::make_unique<JobList>();
             list->setJobs({{1, "Baking 3 reflection probes", "rem-7 of 9, radiance", 0.34, false},
                            {2, "Measuring against the reference", "tracing", -1.0, false}});
             return list;
         }},
        {"timeline", 560, 44,
         [] {
             auto timeline = std::make_unique<Timeline>();
             timeline->setDuration(41.5);
             timeline->setTime(12.4);
             timeline->setPlaying(true);
             return timeline;
         }},
        {"vehicle", 440, 620,
         [] {
             auto card = std::make_unique<VehicleCard>();
             VehicleModel model;
             model.id = "tram";
             model.path = "vehicles/tram.glb";
             card->setModel(model);
             card->setVehicle(std::make_shared<const Vehicle>(builtInVehicle("tram").value()));
             card->setRemarks({{Severity::Info, "scale", "", "The file is in metres.", ""},
                               {Severity::Warning, "paint", "",
                                "The paint would not reflect: clear coat was added.", ""}});
             return card;
         }},
        {"message", 760, 160, message},
        {"report", 620, 420,
         [] {
             auto panel = std::make_unique<ReportPanel>();
             panel->setReport(
                 QStringLiteral("Objects: 1,240 loaded, 3 mended, 1 left out. The ground is "
                                "generated from the buildings."),
                 {{"a.city.json",
                   {Severity::Error, "no-usable-geometry", "NL.IMBAG.Pand.0503100000019674",
                    "skipped: nothing of its geometry can be used", "Export the object again."},
                   "Building",
                   "",
                   "left out"}},
                 {{"a.city.json",
                   {{"Format", "CityJSON 2.0"},
                    {"Coordinates", "EPSG:28992, as the file says"},
                    {"Transformation", "none: the coordinates were taken as they are"},
                    {"Textures", "812 of 830 found"}}}});
             return panel;
         }},
        {"remarks", 800, 220,
         [] {
             auto list = std::make_unique<RemarkList>();
             list->setRemarks(
                 {{"a.city.json",
                   {Severity::Warning, "hole", "NL.IMBAG.Pand.0503100000032914",
                    "A hole in a wall was closed with its own boundary", ""}},
                  {"a.city.json",
                   {Severity::Error, "skip", "NL.IMBAG.Pand.0503100000019674",
                    "Left out: its surface has two points only", "Repair it in the source"}},
                  {"b.city.json", {Severity::Info, "note", "", "No textures", ""}}});
             return list;
         }},
    };
}

QPalette darkPalette() {
    QPalette dark(QColor(45, 48, 54), QColor(35, 38, 43));
    dark.setColor(QPalette::Base, QColor(28, 30, 34));
    dark.setColor(QPalette::AlternateBase, QColor(35, 38, 43));
    dark.setColor(QPalette::Highlight, QColor(60, 120, 190));
    dark.setColor(QPalette::ToolTipBase, QColor(55, 58, 66));
    dark.setColor(QPalette::ToolTipText, Qt::white);
    return dark;
}

class GalleryTest : public testing::TestWithParam<double> {};

TEST_P(GalleryTest, NoTextIsCutOffInAnyPanel) {
    QApplication::setStyle(QStyleFactory::create(QStringLiteral("Fusion")));
    const test::LargerFont larger(GetParam());
    const QString folder = qEnvironmentVariable("REFLET_GALLERY");
    const QPalette light = QApplication::palette();
    for (const bool dark : {false, true}) {
        QApplication::setPalette(dark ? darkPalette() : light);
        for (const Exhibit& exhibit : exhibits()) {
            // Inside of a window, which the window manager may make as large as it likes.
            QWidget window;
            QWidget* widget = exhibit.make().release();
            widget->setParent(&window);
            widget->setGeometry(0, 0, int(exhibit.width * GetParam()),
                                int(exhibit.height * GetParam()));
            widget->setAutoFillBackground(true);
            test::showWidget(window, 1600, 1000);
            QTest::qWait(60);
            for (const std::string& text : test::clippedTexts(*widget))
                ADD_FAILURE() << exhibit.name << ": " << text;
            if (folder.isEmpty())
                continue;
            const QString file = QStringLiteral("%1-%2-%3.png")
                                     .arg(QString::fromLatin1(exhibit.name),
                                          dark ? QStringLiteral("dark") : QStringLiteral("light"))
                                     .arg(int(100 * GetParam()));
            EXPECT_TRUE(widget->grab().save(QDir(folder).filePath(file)));
        }
    }
    QApplication::setPalette(light);
}

INSTANTIATE_TEST_SUITE_P(Scales, GalleryTest, testing::Values(1.0, 1.5, 2.0));

}  // namespace
}  // namespace reflet
