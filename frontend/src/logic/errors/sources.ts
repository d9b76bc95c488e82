/** What the keys of sources mean (`K-H`, `SEED`, `LIBFINS`): models name where a fact comes from in short. */
import { t } from "../../text";

const KEYS = [
  "K-H",
  "K-M",
  "K-L",
  "SEED",
  "W342",
  "W501",
  "W503",
  "LIBFINS",
  "NPM",
  "PY",
  "NSE",
  "SCAN",
  "FS",
  "ELIB",
  "CP1L",
  "CJ08",
  "SYM",
  "IMD",
  "ISS",
  "QSD",
  "RUN",
] as const;

/** The keys in these texts with what they mean, in the order of the legend. */
export function legendOf(sources: readonly string[]): { key: string; meaning: string }[] {
  const said = new Set(sources.flatMap((source) => source.match(/[A-Z][A-Z0-9-]*/g) ?? []));
  return KEYS.filter((key) => said.has(key)).map((key) => ({ key, meaning: t(`source.${key}`) }));
}
