// The three ways in which the same counts are worked up, under one name and colour each wherever they stand.
export const compensations = [
    { label: "as read", colour: "--read" },
    { label: "as in the paper", colour: "--paper" },
    { label: "as configured", colour: "--ours" },
];

export function compared_lines(unit: string): { label: string; colour: string; unit: string }[] {
    return compensations.map(({ label, colour }) => ({ label, colour, unit }));
}
