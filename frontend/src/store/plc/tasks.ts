/** The tasks of the program that runs: the threads of the debugger. */
import { useEffect, useState } from "react";
import { type DebugProtocol, dap } from "../../wire/dap";

/** Asked for when somebody looks; none while the PLC is away. */
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
