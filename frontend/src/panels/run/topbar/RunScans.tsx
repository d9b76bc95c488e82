import { readScan } from "../../../logic/plc/timeline";
import { runScans } from "../../../store/debug/run";
import { t } from "../../../text";
import { AskName } from "../../../ui/AskName";

/** Asks how many scans to run. */
export function RunScans({ onClose }: { onClose: () => void }) {
  async function run(text: string): Promise<void> {
    const scans = readScan(text);
    if (scans === null || scans < 1) throw new Error(t("run.scans.bad"));
    const answer = await runScans(scans);
    if (!answer.ok) throw new Error(answer.message || t("notsent"));
  }
  return (
    <AskName
      title={t("run.scans.title")}
      about={t("run.scans.about")}
      label={t("run.scans.count")}
      action={t("run.scans.do")}
      initial="100"
      onName={run}
      onClose={onClose}
    />
  );
}
