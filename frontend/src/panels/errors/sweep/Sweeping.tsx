import { useSweeps } from "../../../store/errors/sweeps";
import { KeepState } from "./KeepState";
import { RunAll } from "./RunAll";
import "./sweep.css";

/** The dialogs of the sweeps, which several panels open. */
export function Sweeping() {
  const question = useSweeps((sweeps) => sweeps.question);
  if (question?.ask === "run") return <RunAll />;
  if (question?.ask === "keep") return <KeepState scan={question.scan} />;
  return null;
}
