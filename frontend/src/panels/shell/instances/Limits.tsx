import { useState } from "react";
import { changeInstance } from "../../../store/plc/instances";
import { t } from "../../../text";
import { Field } from "../../../ui/Field";
import { FormDialog } from "../../../ui/FormDialog";
import type { Instance, InstanceLimits } from "../../../wire/types";

const LIMITS = [
  { key: "cpu_percent", label: "instances.limit.cpu", minimum: 1, maximum: 100, usual: "instances.limit.none" },
  { key: "memory_mib", label: "instances.limit.memory", minimum: 64, maximum: 65_536, usual: "instances.limit.none" },
  { key: "run_mib", label: "instances.limit.run", minimum: 1, maximum: 65_536, usual: "instances.limit.usual" },
] as const;

type Key = (typeof LIMITS)[number]["key"];

/** The upper limits for the load of an instance. */
export function Limits({ instance, onClose }: { instance: Instance; onClose: () => void }) {
  const [texts, setTexts] = useState<Record<Key, string>>(() => ({
    cpu_percent: String(instance.limits.cpu_percent ?? ""),
    memory_mib: String(instance.limits.memory_mib ?? ""),
    run_mib: String(instance.limits.run_mib ?? ""),
  }));
  const [tried, setTried] = useState(false);

  async function save(): Promise<boolean> {
    setTried(true);
    const limits: InstanceLimits = { cpu_percent: null, memory_mib: null, run_mib: null };
    for (const { key, minimum, maximum } of LIMITS) {
      const value = readLimit(texts[key], minimum, maximum);
      if (value === undefined) return false;
      limits[key] = value;
    }
    await changeInstance(instance, { limits });
    return true;
  }

  return (
    <FormDialog
      title={t("instances.limits.title", instance)}
      about={t("instances.limits.about")}
      submit={t("instances.limits.do")}
      onSubmit={save}
      onClose={onClose}
    >
      {LIMITS.map(({ key, label, minimum, maximum, usual }) => (
        <Field
          key={key}
          label={t(label)}
          value={texts[key]}
          onChange={(text) => setTexts({ ...texts, [key]: text })}
          placeholder={t(usual)}
          refused={
            tried && readLimit(texts[key], minimum, maximum) === undefined
              ? t("instances.limit.range", { minimum, maximum })
              : null
          }
        />
      ))}
    </FormDialog>
  );
}

/** Null is no limit; undefined is an invalid entry. */
function readLimit(text: string, minimum: number, maximum: number): number | null | undefined {
  if (text.trim() === "") return null;
  const value = Number(text);
  return Number.isInteger(value) && value >= minimum && value <= maximum ? value : undefined;
}
