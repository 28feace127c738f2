// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"

#include <QString>
#include <QWidget>
#include <memory>
#include <vector>

namespace reflet {

/// A remark and the file that it is about.
struct FileRemark {
    QString file;
    Diagnostic remark;
    // Of the object that it is about; empty for a remark on the file.
    QString type = {};    ///< as the file has it
    QString lod = {};     ///< the level of detail that was loaded
    QString result = {};  ///< "repaired", in the user's words
};

/// What was found in the city's files: to be filtered, copied, and followed to the object.
class RemarkList : public QWidget {
    Q_OBJECT

public:
    explicit RemarkList(QWidget* parent = nullptr);
    ~RemarkList() override;

    void setRemarks(std::vector<FileRemark> remarks);
    [[nodiscard]] int shownCount() const;

Q_SIGNALS:
    void objectActivated(QString file, QString object);

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

}  // namespace reflet
