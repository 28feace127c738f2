# SPDX-License-Identifier: GPL-3.0-or-later
function(reflet_check_link_graph)
endfunction()
