import { t } from "../../../text";
import { StateWord } from "../../../ui/StateWord";

export function SeverityWord({ severity }: { severity: "fatal" | "nonfatal" }) {
  const fatal = severity === "fatal";
  const tone = fatal ? "fatal" : "warning";
  return <StateWord tone={tone} icon={tone} word={t(fatal ? "errors.fatal" : "errors.nonfatal")} />;
}
