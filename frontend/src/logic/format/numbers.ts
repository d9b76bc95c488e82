/** Numbers and times as the bars show them. */
import { t } from "../../text";

/** 128,411, as the server writes numbers in its sentences, so that long counts can be read. */
export function grouped(value: number): string {
  return Math.trunc(value)
    .toString()
    .replace(/\B(?=(\d{3})+(?!\d))/g, ",");
}

/** A typed number without what groups its digits: 128,411 and 128 411 are 128411; 1,5 stays as it is. */
export function ungrouped(text: string): string {
  const plain = text.replace(/\s/g, "");
  return /^[1-9]\d{0,2}(,\d{3})+$/.test(plain) ? plain.replaceAll(",", "") : plain;
}

/** PLC time as 00:21:24.110; with the number of days before it when there are any. */
export function plcTime(ns: number): string {
  const ms = Math.floor(ns / 1e6);
  const pad = (value: number, width: number) => Math.floor(value).toString().padStart(width, "0");
  const clock = `${pad((ms / 3_600_000) % 24, 2)}:${pad((ms / 60_000) % 60, 2)}:${pad((ms / 1000) % 60, 2)}.${pad(ms % 1000, 3)}`;
  const days = Math.floor(ms / 86_400_000);
  return days > 0 ? `${days}d ${clock}` : clock;
}

/** A measured duration: 0.84 µs, 12.3 µs, 1.12 ms. */
export function microseconds(us: number): string {
  if (us >= 10_000) return `${(us / 1000).toFixed(1)} ms`;
  if (us >= 1000) return `${(us / 1000).toFixed(2)} ms`;
  return us >= 100 ? `${us.toFixed(0)} µs` : `${us.toFixed(us >= 10 ? 1 : 2)} µs`;
}

/** A task interval: 10 ms, 500 µs, 1 s. */
export function interval(ns: number): string {
  if (ns >= 1e9 && ns % 1e9 === 0) return `${ns / 1e9} s`;
  return ns >= 1e6 ? `${ns / 1e6} ms` : `${ns / 1e3} µs`;
}

/** The wall-clock time of an ISO timestamp, in the browser's zone: 14:31:52. */
export function wallTime(iso: string | null): string {
  if (!iso) return "";
  const date = new Date(iso);
  return Number.isNaN(date.getTime()) ? iso : date.toLocaleTimeString("en-GB");
}

/** The wall-clock time of an ISO timestamp, in the browser's zone: 14:20. */
export function clockTime(iso: string): string {
  const date = new Date(iso);
  return Number.isNaN(date.getTime()) ? iso : date.toLocaleTimeString("en-GB", { hour: "2-digit", minute: "2-digit" });
}

/** With its day: 2026-11-21 14:20. */
export function dayTime(iso: string): string {
  const date = new Date(iso);
  if (Number.isNaN(date.getTime())) return iso;
  const pad = (value: number) => value.toString().padStart(2, "0");
  return `${date.getFullYear()}-${pad(date.getMonth() + 1)}-${pad(date.getDate())} ${clockTime(iso)}`;
}

/** Whether an ISO timestamp is of this day, in the browser's zone. */
export const isToday = (iso: string) => new Date(iso).toDateString() === new Date().toDateString();

/** A size in bytes as 3.4 KiB, 12 MiB, 1.2 GiB. */
export function bytes(count: number): string {
  const units = ["B", "KiB", "MiB", "GiB", "TiB"];
  let value = count;
  let unit = 0;
  while (value >= 1000 && unit < units.length - 1) {
    value /= 1024;
    unit += 1;
  }
  return `${value < 10 && unit > 0 ? value.toFixed(1) : Math.round(value)} ${units[unit]}`;
}

/** A length of time in words of at most two units: 420 ms, 21.4 s, 6 min 3 s, 2 h 10 min, 3 d 4 h. */
export function duration(ns: number): string {
  const s = ns / 1e9;
  if (s < 1) return `${Math.round(s * 1000)} ms`;
  if (s < 60) return `${s.toFixed(1)} s`;
  if (s < 3600) return t("duration.minutes", { minutes: Math.floor(s / 60), seconds: Math.floor(s % 60) });
  if (s < 86_400) return t("duration.hours", { hours: Math.floor(s / 3600), minutes: Math.floor((s % 3600) / 60) });
  return t("duration.days", { days: Math.floor(s / 86_400), hours: Math.floor((s % 86_400) / 3600) });
}

/** A share: 0 %, 0.4 %, 12 %. */
export function percent(value: number): string {
  return `${value === 0 || value >= 10 ? Math.round(value) : value.toFixed(1)} %`;
}
