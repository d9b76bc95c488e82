/** The tasks of the running program: the threads of the debugger. */
import { useEffect, useState } from "react";
import { type DebugProtocol, dap } from "../../wire/dap";

/** Requested when somebody needs them; none while the PLC cannot answer. */
export function useTasks(): readonly string[] {
  const [tasks, setTasks] = useState<readonly string[]>([]);
  useEffect(() => {
    let gone = false;
    dap
      .request<DebugProtocol.ThreadsResponse["body"]>("threads")
      .then(({ threads }) => gone || setTasks(threads.map(({ name }) => name)))
      .catch(() => undefined);
    return () => {
      gone = true;
    };
  }, []);
  return tasks;
}
