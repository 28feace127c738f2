// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

class QMainWindow;
class QSplitter;

namespace reflet {

class Checklist;
class Commands;
class CoveragePanel;
class EditIntents;
class Inspector;
class JobList;
class JobRunner;
class LiveCity;
class MapPreview;
class Notices;
class PlanView;
class ProjectDocument;
class ProjectTree;
class ReportPanel;
class Stage;
class SunPanel;
class Timeline;
class TuningPanel;
class Viewport;

/// The parts of one window, for those who tie them together. All of them outlive their users; none
/// is null once the window has been built.
struct Workbench {
    QMainWindow* window = nullptr;
    ProjectDocument* document = nullptr;
    JobRunner* jobs = nullptr;
    LiveCity* live = nullptr;
    Commands* commands = nullptr;
    Notices* notices = nullptr;
    EditIntents* intents = nullptr;  ///< of the picture and the plan

    QSplitter* views = nullptr;  ///< the picture and the plan, side by side
    Stage* stage = nullptr;
    Viewport* viewport = nullptr;
    PlanView* plan = nullptr;
    Timeline* timeline = nullptr;

    ProjectTree* tree = nullptr;
    Inspector* inspector = nullptr;
    TuningPanel* tuning = nullptr;
    MapPreview* preview = nullptr;
    SunPanel* sun = nullptr;
    CoveragePanel* coverage = nullptr;
    Checklist* checklist = nullptr;
    ReportPanel* report = nullptr;
    JobList* jobList = nullptr;
};

}  // namespace reflet
