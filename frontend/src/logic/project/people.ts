/** People at the project, as they are shown. */

/** A name that the server gave to somebody who gave none. */
export const isGuest = (name: string) => /^Guest( \d+)?$/.test(name);
