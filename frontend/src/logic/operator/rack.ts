/** The order of words of inputs and outputs: as the units are in their racks. */
import type { Channel, ChannelUnit } from "../../wire/types";

interface OfUnit {
  /** Null: the words that lead to no unit of the project's hardware. */
  unit: ChannelUnit | null;
  channels: readonly Channel[];
}

/** The words by unit: by rack and slot, then units without a place, then words without a unit. */
export function byUnit(channels: readonly Channel[]): OfUnit[] {
  const found = new Map<string, { unit: ChannelUnit | null; channels: Channel[] }>();
  for (const channel of channels) {
    const unit = channel.unit ?? null;
    const key = unit ? [unit.kind, unit.number, unit.rack, unit.slot].join() : "";
    const group = found.get(key) ?? { unit, channels: [] };
    group.channels.push(channel);
    found.set(key, group);
  }
  const rank = ({ unit }: OfUnit) =>
    unit === null ? Number.MAX_SAFE_INTEGER : 1000 * (unit.rack ?? 1000) + (unit.slot ?? 1000);
  return [...found.values()].sort((a, b) => rank(a) - rank(b));
}
