/** The address that lets somebody in. */
import { isOwnComputer } from "../../logic/plc/links";
import { rest } from "../../wire/rest";
import { linkOrigin, scanLink } from "./links";

/** `host`: the name of this computer in the address, where that leads nobody else here; else null. */
export async function inviteLink(): Promise<{ address: string; host: string | null }> {
  const { token } = await rest.invite();
  const address = new URL(scanLink(null) || linkOrigin());
  address.searchParams.set("token", token);
  return { address: address.href, host: isOwnComputer(address.hostname) ? address.hostname : null };
}
