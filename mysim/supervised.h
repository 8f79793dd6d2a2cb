// A program in two processes: one works, the other sees to it that nothing is left when the first has ended, however.
#pragma once

#include <functional>
#include <string>

namespace crosscheck {

/// Does the work in a child process, hands SIGINT, SIGTERM and SIGHUP on to it, and returns its exit status, or ends as
/// it ended. Before that all that descends from the child is ended too, temporary folders of processes that are gone
/// are removed, and what they left of unfinished results (see tell_supervisor()). Nothing of this runs in a signal
/// handler. A supervisor that is killed takes the child with it; what is left then, the next start removes. To be
/// called first in main(). Where no process can be made, the work is done in this one.
int supervised(const std::function<int()>& work);

/// Names a folder for results that must be seen to where this process is killed. Nothing where there is no supervisor.
void tell_supervisor(const std::string& folder);

}  // namespace crosscheck
