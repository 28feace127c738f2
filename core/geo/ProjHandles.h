// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <proj.h>
#include <proj_experimental.h>  // promotion to and from three dimensions

#include <memory>
#include <string>

namespace reflet {

/// Owners of PROJ's handles, and the one way in which Reflet makes a context. Only for the .cpp
/// files of core/geo.
struct ProjDelete {
    void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
    void operator()(PJ* object) const { proj_destroy(object); }
    void operator()(PJ_OPERATION_FACTORY_CONTEXT* factory) const {
        proj_operation_factory_context_destroy(factory);
    }
};
using ProjObject = std::unique_ptr<PJ, ProjDelete>;

/// A context without network access that keeps its last message instead of printing it.
/// Not to be used from two threads at once (PROJ's rule).
class ProjContext {
public:
    ProjContext();
    [[nodiscard]] PJ_CONTEXT* get() const { return m_context.get(); }
    /// The last message of PROJ, and forgets it; empty when there was none.
    [[nodiscard]] std::string takeMessage() const;

private:
    std::unique_ptr<std::string> m_message;  ///< its address is known to PROJ
    std::unique_ptr<PJ_CONTEXT, ProjDelete> m_context;
};

/// The calling thread's own context.
[[nodiscard]] const ProjContext& threadProjContext();

}  // namespace reflet
