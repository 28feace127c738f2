// SPDX-License-Identifier: GPL-3.0-or-later
// Internal to app/pipeline.
#pragma once

#include "app/pipeline/PreparedCity.h"
#include "core/gpu/SceneRenderer.h"

namespace reflet {

/// The calling thread's renderer, its context current, showing that city in its light, soft light
/// included. Context and renderer are made at the first call and kept for the thread's next ones;
/// what it shows already is not uploaded again. Valid until the next call on the thread or until
/// another context is made current. ResourceLimit, with a remedy, where there is no OpenGL 4.5.
[[nodiscard]] Result<SceneRenderer*> glStage(const PreparedCity& city, const JobContext& job);

}  // namespace reflet
