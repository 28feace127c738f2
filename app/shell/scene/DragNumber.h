// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/document/ProjectDocument.h"
#include "widgets/ViewIntents.h"

namespace reflet {

/// Turns the phases of a drag into the document's drag numbers: what happens between Begin and End
/// becomes one step of undo, what ends with Cancel none. One drag goes on at a time.
class DragNumber {
public:
    explicit DragNumber(ProjectDocument& document) : m_document(document) {}

    /// Calls `change` with the drag's number (-1: a step of its own), or takes the drag back.
    template <class Change>
    void apply(DragPhase phase, const Change& change) {
        switch (phase) {
            case DragPhase::Begin:
                m_number = m_document.beginDrag();
                change(m_number);
                break;
            case DragPhase::Move:
                change(m_number);
                break;
            case DragPhase::End:
                change(m_number);
                finish();
                break;
            case DragPhase::Cancel:
                if (m_number >= 0) {
                    m_document.cancelDrag(m_number);
                }
                finish();
                break;
        }
    }

    [[nodiscard]] bool active() const { return m_number >= 0; }

private:
    void finish() {
        if (m_number >= 0) {
            m_document.endDrag();
        }
        m_number = -1;
    }

    ProjectDocument& m_document;
    int m_number = -1;
};

}  // namespace reflet
