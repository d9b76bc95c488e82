/** Reconnects now, without waiting for the next turn of the back-off. */
import { link } from "../../wire/socket";

export function reconnectNow(): void {
  link.tryNow();
}
